#pragma once

#include <span>
#include <stop_token>
#include <string_view>

#include "ctl/command_line.hpp"

namespace CLI {
class App;
}

namespace slod::ctl {

/// One command of slodctl.
struct CommandEntry {
    std::string_view name;
    std::string_view help;                             ///< what it does, for --help
    void (*declare)(CLI::App& app, CommandLine& line); ///< its own options
    ExitCode (*run)(const CommandLine& line, const std::stop_token& stop);
};

/// All commands; the only list of them.
std::span<const CommandEntry> commands();

ExitCode run_status(const CommandLine& line, const std::stop_token& stop);
ExitCode run_watch(const CommandLine& line, const std::stop_token& stop);
ExitCode run_roi(const CommandLine& line, const std::stop_token& stop);

/// Sends the request and waits for its answer, which it prints.
ExitCode run_steering(const CommandLine& line, const std::stop_token& stop);
ExitCode run_stats(const CommandLine& line, const std::stop_token& stop);

/// Prints the errors of accelerations, of all particles and by region.
ExitCode run_errors(const CommandLine& line, const std::stop_token& stop);

/// Lists the effects, or sends a change of them.
ExitCode run_effect(const CommandLine& line, const std::stop_token& stop);
ExitCode run_echo(const CommandLine& line, const std::stop_token& stop);

/// hz, bw and latency of a topic, once a second.
ExitCode run_traffic(const CommandLine& line, const std::stop_token& stop);

} // namespace slod::ctl
