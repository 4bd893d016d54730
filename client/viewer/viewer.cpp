#include "viewer/viewer.hpp"

#include <chrono>

#include "viewer/hands.hpp"
#include "viewer/picture_file.hpp"

namespace slod::viewer {

namespace {

using Clock = std::chrono::steady_clock;

/// A name that is not taken yet.
std::filesystem::path next_picture(const std::filesystem::path& folder)
{
    for (int number = 1;; ++number) {
        std::filesystem::path path = folder / ("slod-viewer-" + std::to_string(number) + ".png");
        if (!std::filesystem::exists(path))
            return path;
    }
}

} // namespace

Viewer::Viewer(const CommandLine& line) : window_(line.size, "SLOD"), model_(line) {}

/// Draws where there is something new: input and what it sets off, a frame, or a while has passed and numbers
/// in the panels are old.
void Viewer::run(const std::stop_token& stop)
{
    constexpr double poll_s = 0.008;
    constexpr std::chrono::milliseconds longest_rest{250};
    constexpr int frames_of_input = 3; // what Dear ImGui needs to come to rest
    int restless = frames_of_input;
    Clock::time_point last{};
    while (!window_.closing() && !stop.stop_requested()) {
        if (window_.wait_for_input(restless > 0 ? 0.001 : poll_s))
            restless = frames_of_input;
        const bool news = model_.exchange();
        if (!news && restless == 0 && Clock::now() - last < longest_rest)
            continue;
        last = Clock::now();
        restless = std::max(restless - 1, 0);
        show_frame();
    }
}

void Viewer::show_frame()
{
    model_.viewport = window_.viewport();
    const auto input = window_.take_input();
    if (model_.viewport.width == 0 || model_.viewport.height == 0) // the window is minimised
        return;
    window_.begin_panels();
    use_hands(model_, input);
    paint_scene();
    write_picture();
    panels_.draw(model_);
    window_.end_panels();
    window_.show();
}

void Viewer::paint_scene()
{
    constexpr GLuint window_framebuffer = 0;
    const bool for_file = model_.picture_wanted;
    Look look = model_.look;
    look.finest = for_file;
    painter_.paint(model_.frame(), look, model_.viewport, model_.outlines(!for_file), window_framebuffer);
    model_.colour_range = painter_.range();
}

void Viewer::write_picture()
{
    if (!std::exchange(model_.picture_wanted, false))
        return;
    const std::filesystem::path path = next_picture(model_.output_folder);
    try {
        write_png(read_pixels(model_.viewport), path);
        model_.steering.set_notice("picture written to " + path.string());
    } catch (const std::exception& error) {
        model_.steering.set_notice(error.what());
    }
}

ExitCode run_in_window(const CommandLine& line, const std::stop_token& stop)
{
    Viewer(line).run(stop);
    return ExitCode::Success;
}

} // namespace slod::viewer
