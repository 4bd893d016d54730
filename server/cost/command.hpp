#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "core/settings.hpp"

/// What the commands of slod-cost have in common.
namespace slod::cost {

inline constexpr int failed = 1, wrong = 2; ///< exit codes beside 0

/// Prints the problems to stderr; returns the exit code.
int complain(const Problems& problems);

/// As asked for; 0: one thread per core.
int team_size(int threads);
void add_threads_option(CLI::App& command, int& threads);

std::string machine_name(); ///< host, number and name of processors

} // namespace slod::cost
