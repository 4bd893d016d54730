#include "viewer/model.hpp"

#include <unistd.h>

#include "view/scene_bounds.hpp"

namespace slod::viewer {

namespace {

std::string viewer_name(const CommandLine& line)
{
    return line.client_name.empty() ? "viewer-" + std::to_string(getpid()) : line.client_name;
}

std::array<double, 3> array_of(const view::Vector& from)
{
    return {from.x(), from.y(), from.z()};
}

} // namespace

Model::Model(const CommandLine& line)
    : connection(line.server.domain, line.server.profile,
                 {.stats = true, .clusters = true, .errors = true, .regions = true, .region = line.region}),
      alarms(connection.participant()),
      steering(connection.participant(), viewer_name(line)), look{.camera =
                                                                      line.camera.value_or(view::Camera{}),
                                                                  .colours = line.colours,
                                                                  .detail{},
                                                                  .exposure = line.exposure},
      viewport(line.size), camera_file(line.camera_file), output_folder(line.output_folder),
      show_outlines(line.outlines), fit_wanted_(!line.camera)
{
    steering.follow(line.follow);
}

bool Model::exchange()
{
    connection.poll();
    alarms.poll();
    if (connection.status().contact == client::Contact::NoServer)
        steering.lose_server();
    else if (steering.set_server(connection.server()->session))
        history.reset();
    if (connection.stats())
        history.add(*connection.stats(), connection.error());
    steering.editor.on_regions(connection.regions());
    if (connection.frame() && connection.frame()->nodes() > 0 && std::exchange(fit_wanted_, false))
        fit_camera();
    steering.poll(connection.regions(), client_view(), Steering::Clock::now());
    return std::exchange(shown_frames_, connection.complete_frames()) != connection.complete_frames();
}

const client::ClusterFrame* Model::frame() const
{
    return frozen_ ? &*frozen_ : connection.frame();
}

void Model::freeze(bool wanted)
{
    if (!wanted)
        frozen_.reset();
    else if (!frozen_ && connection.frame())
        frozen_ = *connection.frame();
}

void Model::toggle_pause()
{
    if (const client::ServerInfo* server = connection.server())
        steering.send({.kind = server->paused ? "resume" : "pause"});
}

void Model::step(std::uint32_t frames)
{
    steering.send({.kind = "step", .frames = frames});
}

void Model::fit_camera()
{
    if (const client::ClusterFrame* shown = frame()) {
        const view::Ball bulk = view::bulk_of(*shown);
        look.camera = view::fitted(look.camera, bulk.centre, bulk.radius);
    }
}

client::ClientView Model::client_view() const
{
    return {.eye = array_of(look.camera.eye()),
            .look_at = array_of(look.camera.look_at),
            .up = array_of(look.camera.up()),
            .field_of_view_deg = look.camera.field_of_view_deg,
            .width_px = std::uint32_t(viewport.width),
            .height_px = std::uint32_t(viewport.height)};
}

std::vector<OutlinedRegion> Model::outlines(bool with_handles) const
{
    using Phase = view::RegionEditor::Phase;
    constexpr std::uint32_t white = 0xffffffff, amber = 0xff20b0ff;
    std::vector<OutlinedRegion> made;
    if (!show_outlines)
        return made;
    for (const auto& [name, region] : connection.regions()) {
        const view::RegionPose* const echo = steering.editor.echo(name);
        const Phase phase = steering.editor.phase(name);
        OutlinedRegion outlined{.segments = view::outline(region, echo, look.camera.distance),
                                .handles{},
                                .colour = phase == Phase::Settled   ? view::region_colour(name)
                                          : phase == Phase::Pending ? amber
                                                                    : white};
        const std::optional<view::RegionPose> pose = echo ? *echo : view::pose_of(region);
        if (with_handles && pose)
            for (const view::Handle& handle : view::all_handles())
                outlined.handles.push_back(view::place_of(handle, *pose));
        made.push_back(std::move(outlined));
    }
    return made;
}

} // namespace slod::viewer
