#include <cstdio>
#include <exception>
#include <variant>

#include "idl/dds.hpp"
#include "idl/stop_on_signal.hpp"
#include "viewer/command_line.hpp"
#include "viewer/headless.hpp"
#include "viewer/viewer.hpp"

int main(int argc, char** argv)
try {
    const slod::StopOnSignal signals; // first: every later thread inherits the blocked signals
    const auto parsed = slod::viewer::parse_command_line(argc, argv);
    if (const auto* code = std::get_if<slod::viewer::ExitCode>(&parsed))
        return int(*code);
    const auto& line = std::get<slod::viewer::CommandLine>(parsed);
    const auto run = line.screenshot.empty() ? slod::viewer::run_in_window : slod::viewer::run_headless;
    return int(run(line, signals.token()));
} catch (const slod::wire::DdsError& error) {
    std::fprintf(stderr, "slod-viewer: %s\n", error.what());
    return int(error.not_permitted() ? slod::viewer::ExitCode::NotPermitted
                                     : slod::viewer::ExitCode::Failure);
} catch (const std::exception& error) {
    std::fprintf(stderr, "slod-viewer: %s\n", error.what());
    return int(slod::viewer::ExitCode::Failure);
}
