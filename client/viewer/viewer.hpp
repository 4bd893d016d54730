#pragma once

#include <stop_token>

#include "viewer/model.hpp"
#include "viewer/panels.hpp"
#include "viewer/scene_painter.hpp"
#include "viewer/window.hpp"

namespace slod::viewer {

/// The viewer in a window.
class Viewer {
public:
    /// Throws wire::DdsError or std::runtime_error with a remedy.
    explicit Viewer(const CommandLine& line);

    /// Until the window is closed or stop is requested.
    void run(const std::stop_token& stop);

private:
    void show_frame();
    void paint_scene();
    void write_picture();

    Window window_;
    Model model_;
    ScenePainter painter_;
    Panels panels_;
};

/// Opens the window and shows it until its end.
ExitCode run_in_window(const CommandLine& line, const std::stop_token& stop);

} // namespace slod::viewer
