#pragma once

#include <stop_token>

#include "viewer/command_line.hpp"

namespace slod::viewer {

/// Waits for the frames asked for, draws the last one without a screen and writes the picture. Says on stderr
/// what went wrong and what helps.
ExitCode run_headless(const CommandLine& line, const std::stop_token& stop);

} // namespace slod::viewer
