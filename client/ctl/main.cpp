#include <cstdio>
#include <exception>
#include <variant>

#include "ctl/commands.hpp"
#include "idl/dds.hpp"
#include "idl/stop_on_signal.hpp"

int main(int argc, char** argv)
try {
    const slod::StopOnSignal signals; // first: every later thread inherits the blocked signals
    const auto parsed = slod::ctl::parse_command_line(argc, argv);
    if (const auto* code = std::get_if<slod::ctl::ExitCode>(&parsed))
        return int(*code);
    const auto& line = std::get<slod::ctl::CommandLine>(parsed);
    for (const slod::ctl::CommandEntry& command : slod::ctl::commands())
        if (command.name == line.command)
            return int(command.run(line, signals.token()));
    return int(slod::ctl::ExitCode::Usage);
} catch (const slod::wire::DdsError& error) {
    std::fprintf(stderr, "slodctl: %s\n", error.what());
    return int(error.not_permitted() ? slod::ctl::ExitCode::NotPermitted : slod::ctl::ExitCode::Failure);
} catch (const std::exception& error) {
    std::fprintf(stderr, "slodctl: %s\n", error.what());
    return int(slod::ctl::ExitCode::Failure);
}
