#pragma once

#include <optional>
#include <string>

#include "common/alarm_board.hpp"
#include "common/connection.hpp"
#include "view/history.hpp"
#include "viewer/command_line.hpp"
#include "viewer/scene_painter.hpp"
#include "viewer/steering.hpp"

namespace slod::viewer {

/// What the window shows and what hands and panels change: all of the viewer but its screen.
class Model {
public:
    /// Throws wire::DdsError with a remedy.
    explicit Model(const CommandLine& line);

    /// Takes in what has arrived, sends what is due. True when there is something new to be seen.
    bool exchange();

    /// The frame to draw: the newest one, or the one that the view was frozen at; null before there was one.
    const client::ClusterFrame* frame() const;

    bool frozen() const { return frozen_.has_value(); }
    void freeze(bool wanted);

    /// Pauses a running simulation, and lets a paused one go on.
    void toggle_pause();
    void step(std::uint32_t frames);

    /// Points the camera at the bulk of the scene.
    void fit_camera();

    view::Lens lens() const { return view::Lens(look.camera, viewport); }

    /// What the view topic is told.
    client::ClientView client_view() const;

    /// Outlines of all regions, those that are dragged or pending as they will be; handles when asked for.
    std::vector<OutlinedRegion> outlines(bool with_handles) const;

    client::Connection connection;
    client::AlarmBoard alarms;
    Steering steering;
    view::History history;
    Look look;
    view::Viewport viewport;
    view::Range colour_range; ///< of the frame that was drawn last
    std::filesystem::path camera_file;
    std::filesystem::path output_folder;
    bool show_outlines;
    bool show_panels = true;
    bool show_help = false;
    bool picture_wanted = false; ///< the next frame goes into a file, too

private:
    std::optional<client::ClusterFrame> frozen_;
    bool fit_wanted_; ///< by the first frame, once
    std::uint64_t shown_frames_ = 0;
};

} // namespace slod::viewer
