#include "arguments/parsing.hpp"

namespace slod::client {

std::optional<ExitCode> parse(CLI::App& app, int argc, const char* const* argv)
{
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? ExitCode::Success : ExitCode::Usage;
    }
    return {};
}

} // namespace slod::client
