#pragma once

#include "ctl/command_line.hpp"

namespace CLI {
class App;
}

namespace slod::ctl {

// Options of the commands that steer a running scene: they fill in the request.
void declare_simple(CLI::App& app, CommandLine& line); ///< pause, resume, stop
void declare_step(CLI::App& app, CommandLine& line);
void declare_set(CLI::App& app, CommandLine& line);
void declare_target(CLI::App& app, CommandLine& line); ///< a frame rate, an error, or both, as settings
void declare_effect(CLI::App& app, CommandLine& line);
void declare_roi(CLI::App& app, CommandLine& line);

} // namespace slod::ctl
