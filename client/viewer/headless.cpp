#include "viewer/headless.hpp"

#include <cstdio>

#include "common/connection.hpp"
#include "common/waiting.hpp"
#include "view/scene_bounds.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/picture_file.hpp"
#include "viewer/scene_painter.hpp"

namespace slod::viewer {

namespace {

void complain(const std::string& sentence)
{
    std::fprintf(stderr, "slod-viewer: %s\n", sentence.c_str());
}

std::vector<OutlinedRegion> outlines(const client::Connection::Regions& regions, const view::Camera& camera)
{
    std::vector<OutlinedRegion> made;
    for (const auto& [name, region] : regions)
        made.push_back({.segments = view::outline(region, nullptr, camera.distance),
                        .handles{},
                        .colour = view::region_colour(name)});
    return made;
}

void draw(const CommandLine& line, const client::Connection& connection)
{
    const client::ClusterFrame& frame = *connection.frame();
    const view::Ball bulk = view::bulk_of(frame);
    const Look look{.camera = line.camera.value_or(view::fitted(view::Camera{}, bulk.centre, bulk.radius)),
                    .colours = line.colours,
                    .detail{},
                    .exposure = line.exposure,
                    .finest = true};
    const OffscreenContext context;
    const Target target(line.size.width, line.size.height, GL_RGBA8);
    ScenePainter painter;
    painter.paint(&frame, look, line.size,
                  line.outlines ? outlines(connection.regions(), look.camera) : std::vector<OutlinedRegion>{},
                  target.framebuffer());
    write_png(read_pixels(line.size), line.screenshot);
}

} // namespace

ExitCode run_headless(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile,
                                  {.clusters = true, .regions = true, .region = line.region});
    const client::Clock::time_point end = deadline(line.server);
    const auto present = [&] { return connection.status().contact != client::Contact::NoServer; };
    if (!wait_until(connection, stop, end, present)) {
        complain(no_server_sentence(connection.status()));
        return ExitCode::NoServer;
    }
    const client::ServerInfo& server = *connection.server();
    std::fprintf(stderr, "slod-viewer: hears slod-server %s on %s, process %u\n", server.version.c_str(),
                 server.host.c_str(), server.process);
    const auto complete = [&] {
        return connection.complete_frames() >= line.frames && connection.frame()->frame >= line.from_frame &&
               connection.knows_all_regions();
    };
    const auto region_unknown = [&] { return !line.region.empty() && connection.lacks_region(line.region); };
    wait_until(connection, stop, end, [&] { return complete() || region_unknown() || !present(); });
    if (region_unknown()) {
        complain(client::no_region_sentence(line.region));
        return ExitCode::NotFound;
    }
    if (!complete()) {
        complain(no_news_sentence(std::to_string(connection.complete_frames()) +
                                      " frames came in time, and not those asked for",
                                  connection));
        return present() ? ExitCode::TimedOut : ExitCode::NoServer;
    }
    draw(line, connection);
    return ExitCode::Success;
}

} // namespace slod::viewer
