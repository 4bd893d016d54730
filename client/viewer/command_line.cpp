#include "viewer/command_line.hpp"

#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "arguments/parsing.hpp"
#include "idl/version.hpp"
#include "viewer/camera_file.hpp"

namespace slod::viewer {

namespace {

constexpr int smallest_px = 16, largest_px = 8192;

/// Two numbers with `mark` between them.
template <class Number>
std::optional<std::pair<Number, Number>> pair_of(const std::string& text, char mark)
{
    const char* const end = text.data() + text.size();
    Number first{}, second{};
    const auto [middle, wrong] = std::from_chars(text.data(), end, first);
    if (wrong != std::errc() || middle == end || *middle != mark)
        return {};
    const auto [last, also_wrong] = std::from_chars(middle + 1, end, second);
    if (also_wrong != std::errc() || last != end)
        return {};
    return std::pair{first, second};
}

void declare_connection(CLI::App& app, CommandLine& line)
{
    client::add_server_options(app, line.server,
                               "With --screenshot: seconds to wait for a server and its frames");
    app.add_option("--region", line.region, "Show the clusters of this region alone; without it, all")
        ->option_text("NAME");
}

void declare_camera(CLI::App& app, CommandLine& line)
{
    const auto take = [&line](const std::string& text) {
        const auto read = view::camera_of(text);
        if (const auto* wrong = std::get_if<std::string>(&read))
            throw CLI::ValidationError("--camera", *wrong);
        line.camera = std::get<view::Camera>(read);
    };
    app.add_option_function<std::string>("--camera", take,
                                         "Where to look from, such as \"" + view::to_text(view::Camera{}) +
                                             "\"; lengths are the scene's, angles degrees. What is left out "
                                             "is as here. Without it, and without a "
                                             "camera file, the first frame sets the camera, once")
        ->option_text("TEXT");
    app.add_option(
           "--camera-file", line.camera_file,
           "Where Ctrl-S saves the camera and Ctrl-L loads it; without --camera it is read at the start, "
           "if it is there")
        ->option_text("FILE [slod-camera.txt]");
}

void declare_look(CLI::App& app, CommandLine& line)
{
    client::add_choice(app, "--colour-by", line.colours.by, "Colour by speed, mass, count, region or age");
    app.add_flag("--log", line.colours.logarithmic, "Colours on a logarithmic scale");
    const auto take_range = [&line](const std::string& text) {
        const auto range = pair_of<double>(text, ',');
        if (!range || !(range->second > range->first))
            throw CLI::ValidationError("--range", text + " is no range; write LOW,HIGH");
        line.colours.automatic = false;
        std::tie(line.colours.low, line.colours.high) = *range;
    };
    app.add_option_function<std::string>(
           "--range", take_range, "What the ends of the colours stand for; without it, the values at hand")
        ->option_text("LOW,HIGH");
    app.add_option("--exposure", line.exposure, "Brightness; without it, by the light that there is")
        ->check(between(1e-6, 1e6))
        ->option_text("FACTOR [1]");
    app.add_flag_callback(
        "--no-outlines", [&line] { line.outlines = false; }, "Do not draw the regions of interest");
    app.callback([&line] {
        if (line.colours.logarithmic && !line.colours.automatic && !(line.colours.low > 0))
            throw CLI::ValidationError("--range", "a logarithmic scale begins above 0; leave out --log or "
                                                  "write a LOW above 0");
    });
    const auto take_size = [&line](const std::string& text) {
        const auto size = pair_of<int>(text, 'x');
        const auto fits = [](int px) { return px >= smallest_px && px <= largest_px; };
        if (!size || !fits(size->first) || !fits(size->second))
            throw CLI::ValidationError("--size",
                                       text + " is no size; write WIDTHxHEIGHT, each 16 to 8192 pixels");
        line.size = {.width = size->first, .height = size->second};
    };
    app.add_option_function<std::string>("--size", take_size, "Size of the window or picture [px]")
        ->option_text("WIDTHxHEIGHT [1280x720]");
}

void declare(CLI::App& app, CommandLine& line)
{
    declare_connection(app, line);
    declare_camera(app, line);
    declare_look(app, line);
    CLI::Option* const follow = app.add_flag(
        "--follow", line.follow, "Add a frustum region that moves with the camera, until the viewer ends");
    app.add_option(
           "--name", line.client_name,
           "Name of this viewer, which frustum regions can follow; without it, viewer and its process")
        ->option_text("NAME");
    app.add_option("--output-dir", line.output_folder, "Folder of the pictures that key e writes")
        ->check(CLI::ExistingDirectory)
        ->option_text("FOLDER [.]");
    CLI::Option* const screenshot =
        app.add_option("--screenshot", line.screenshot, "Write one PNG picture and end; needs no screen")
            ->check(writable_png())
            ->option_text("FILE.png")
            ->excludes(follow);
    app.add_option("--frames", line.frames, "With --screenshot: complete frames to wait for")
        ->check(at_least_one())
        ->needs(screenshot)
        ->option_text("N [1]");
    app.add_option("--from-frame", line.from_frame,
                   "With --screenshot: wait for the server's frame of this number")
        ->check(at_least_zero<std::uint64_t>())
        ->needs(screenshot)
        ->option_text("N [0]");
    app.set_version_flag("--version", "slod-viewer " + std::string(version()));
}

} // namespace

std::variant<CommandLine, ExitCode> parse_command_line(int argc, const char* const* argv)
{
    CLI::App app("Shows what a running slod-server simulates, and steers its regions of interest.",
                 "slod-viewer");
    app.footer(
        "In the window, h shows keys and mouse. CYCLONEDDS_URI, when set, replaces the profile.\n"
        "Exit codes: 0 done, 1 network or screen not usable, 2 wrong usage or camera file, 66 unknown name,\n"
        "69 no server, 75 timed out, 77 not permitted.\n"
        "Example: slod-viewer --screenshot galaxy.png --camera \"distance=60 elevation=40\" --log");
    CommandLine line;
    declare(app, line);
    if (const auto code = client::parse(app, argc, argv))
        return *code;
    try {
        if (!line.camera)
            line.camera = load_camera(line.camera_file);
    } catch (const std::runtime_error& error) {
        std::fprintf(stderr, "slod-viewer: %s\n", error.what());
        return ExitCode::Usage;
    }
    return line;
}

} // namespace slod::viewer
