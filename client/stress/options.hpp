#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "arguments/server_choice.hpp"
#include "common/exit_code.hpp"
#include "stress/limits.hpp"
#include "stress/order.hpp"

namespace slod::stress {

using client::ExitCode;

/// What was asked for.
struct Options {
    std::uint32_t subscribers = 8; ///< with the following, which are among them
    std::uint32_t best_effort = 0, slow = 0, stopped = 0, joiners = 0;
    std::uint32_t commanders = 0;
    double seconds = 10;        ///< of load
    double baseline_s = 5;      ///< of rest before it; 0: none
    double settle_s = 3;        ///< between, when the clients have joined: they still find each other
    Rates rates{};              ///< of each commander
    std::uint64_t commands = 0; ///< of all commanders together; 0: any number
    std::string region;         ///< whose clusters are read; empty: all
    double slow_ms = 200;       ///< sleep of a slow subscriber after each sample
    std::uint32_t regions = 1;  ///< of each commander
    double extent = 1;          ///< commanders' regions lie within so far of the origin, in scene lengths
    std::uint64_t seed = 1;
    client::ServerChoice server;
    std::vector<int> cpus; ///< on which all clients run; empty: any
    bool sweep = false;
    bool json = false;
    std::string picture; ///< file; empty: none
    Limits limits;
};

/// Reads the command line. When it is wrong, or asks for --help or --version alone, has already printed what
/// there is to say and gives the exit code.
std::variant<Options, ExitCode> parse_options(int argc, const char* const* argv);

/// Prints one sentence to stderr.
void complain(const std::string& sentence);

} // namespace slod::stress
