#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "arguments/server_choice.hpp"
#include "common/exit_code.hpp"
#include "view/camera.hpp"
#include "view/colour_scale.hpp"

namespace slod::viewer {

using client::ExitCode;

/// What was asked for.
struct CommandLine {
    client::ServerChoice server;
    std::string region; ///< the only one whose clusters are shown; empty: all

    std::optional<view::Camera> camera; ///< named, or read from the camera file
    std::filesystem::path camera_file = "slod-camera.txt";
    view::ColourScale colours;
    double exposure = 1;
    bool outlines = true; ///< of the regions
    view::Viewport size;

    bool follow = false;       ///< add a frustum region that moves with the camera
    std::string client_name{}; ///< of the view; empty: viewer and its process

    std::filesystem::path output_folder = "."; ///< of pictures that are asked for in the window
    std::filesystem::path screenshot;          ///< empty: open a window
    std::uint64_t frames = 1;                  ///< complete ones to wait for before the screenshot
    std::uint64_t from_frame = 0; ///< number of the first of the server's frames that may be drawn
};

/// Reads the command line. When it is wrong, or asks for --help or --version alone, has already printed what
/// there is to say and gives the exit code.
std::variant<CommandLine, ExitCode> parse_command_line(int argc, const char* const* argv);

} // namespace slod::viewer
