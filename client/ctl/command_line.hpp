#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "arguments/server_choice.hpp"
#include "common/commander.hpp"
#include "common/exit_code.hpp"

namespace slod::ctl {

using client::ExitCode;

/// What was asked for.
struct CommandLine {
    std::string command;
    bool json = false; ///< one object per line instead of text
    client::ServerChoice server;
    std::uint64_t count = 0;        ///< updates, or samples of echo; 0: until stopped
    bool clusters = false;          ///< watch: receive the cluster states too
    bool best_effort = false;       ///< watch: do not ask again for lost fragments of them
    std::vector<std::string> names; ///< stats: values to print; empty: all
    std::string topic;              ///< echo, hz, bw, latency
    std::string region;             ///< likewise: of this region alone; empty: all
    client::CommandRequest request; ///< of what steers; roi list and show: without a kind
};

/// Reads the command line. When it is wrong, or asks for --help or --version alone, has already printed what
/// there is to say and gives the exit code.
std::variant<CommandLine, ExitCode> parse_command_line(int argc, const char* const* argv);

} // namespace slod::ctl
