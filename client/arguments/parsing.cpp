#include "arguments/parsing.hpp"

namespace slod::client {

namespace {

ExitCode code_of(const CLI::ParseError& error)
{
    switch (static_cast<CLI::ExitCodes>(error.get_exit_code())) {
    case CLI::ExitCodes::Success:
        return ExitCode::Success;
    case CLI::ExitCodes::ConversionError:
    case CLI::ExitCodes::ValidationError:
        return ExitCode::InvalidArgument;
    default:
        return ExitCode::Usage;
    }
}

} // namespace

std::optional<ExitCode> parse(CLI::App& app, int argc, const char* const* argv)
{
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        app.exit(error);
        return code_of(error);
    }
    return {};
}

} // namespace slod::client
