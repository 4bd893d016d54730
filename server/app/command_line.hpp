#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace slod {

/// What the process tells its caller.
enum class ExitCode : int {
    Success = 0,
    Failure = 1, ///< it could not start or finish what was asked
    Usage = 2,   ///< the command line, the scene or the initial conditions are wrong
};

/// What was asked for. An empty path: not asked for.
struct CommandLine {
    std::filesystem::path scene;
    std::filesystem::path input;         ///< initial conditions instead of the scene's own
    std::filesystem::path replay;        ///< input log to run again, instead of a scene
    std::vector<std::string> settings;   ///< "table.key=value", in order; part of what is simulated
    std::vector<std::string> placement;  ///< likewise; where and how fast it runs, never what comes out
    std::uint64_t frames = 0;            ///< 0: until stopped
    bool free_run = false;               ///< as fast as possible, without the pacer
    std::filesystem::path report;        ///< JSON
    std::filesystem::path picture;       ///< PNG
    std::filesystem::path trace;         ///< CSV
    std::filesystem::path output_folder; ///< of the input log
    bool keys = false;                   ///< print every key of a scene file
    bool explain = false;                ///< print the plan
    bool check = false;                  ///< read everything, run nothing
};

/// Reads the command line. When it is wrong, or asks for --help or --version alone, has already printed
/// what there is to say and gives the exit code.
std::variant<CommandLine, ExitCode> parse_command_line(int argc, const char* const* argv);

} // namespace slod
