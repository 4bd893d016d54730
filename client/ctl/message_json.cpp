#include "ctl/message_json.hpp"

#include "common/alarm_board.hpp"
#include "common/commander.hpp"

namespace slod::ctl {

namespace {

Json uuid(const slod_v1_Uuid& field)
{
    return wire::to_string(wire::uuid_of(field));
}

Json vector(const slod_v1_Vector& field)
{
    return {field.x, field.y, field.z};
}

/// Of numbers.
template <class Sequence>
Json list(const Sequence& sequence)
{
    Json values = Json::array();
    for (const auto& value : wire::span_of(sequence))
        values.push_back(value);
    return values;
}

template <class Sequence>
Json assignments(const Sequence& settings)
{
    Json values = Json::object();
    for (const wire::Assignment& entry : wire::span_of(settings))
        values[entry.setting] = entry.value;
    return values;
}

} // namespace

Json json_of(const wire::Clusters& message)
{
    return {{"session", uuid(message.session)},
            {"region", message.region},
            {"serial", message.serial},
            {"frame", message.frame},
            {"time", message.time},
            {"region_clusters", message.region_clusters},
            {"clusters_per_node", message.clusters_per_node},
            {"origin", vector(message.origin)},
            {"position", list(message.position)},
            {"velocity", list(message.velocity)},
            {"mass", list(message.mass)},
            {"particles", list(message.particles)},
            {"covariance", list(message.covariance)},
            {"cluster_id", list(message.cluster_id)},
            {"formation", list(message.formation)}};
}

Json json_of(const wire::Overview& message)
{
    return {{"session", uuid(message.session)},
            {"serial", message.serial},
            {"frame", message.frame},
            {"time", message.time},
            {"scene_clusters", message.scene_clusters},
            {"clusters_per_node", message.clusters_per_node},
            {"origin", vector(message.origin)},
            {"position", list(message.position)},
            {"velocity", list(message.velocity)},
            {"mass", list(message.mass)},
            {"particles", list(message.particles)},
            {"radius", list(message.radius)}};
}

Json json_of(const wire::FrameManifest& message)
{
    Json json = {{"session", uuid(message.session)},
                 {"serial", message.serial},
                 {"frame", message.frame},
                 {"time", message.time},
                 {"regions", Json::array()}};
    for (const wire::RegionCount& entry : wire::span_of(message.regions))
        json["regions"].push_back({{"region", entry.region},
                                   {"region_clusters", entry.region_clusters},
                                   {"published_nodes", entry.published_nodes}});
    return json;
}

Json json_of(const wire::Members& message)
{
    return {{"session", uuid(message.session)},
            {"region", message.region},
            {"serial", message.serial},
            {"frame", message.frame},
            {"time", message.time},
            {"region_particles", message.region_particles},
            {"one_in", message.one_in},
            {"origin", vector(message.origin)},
            {"particle_id", list(message.particle_id)},
            {"cluster_id", list(message.cluster_id)},
            {"position", list(message.position)},
            {"velocity", list(message.velocity)},
            {"mass", list(message.mass)},
            {"kind", list(message.kind)}};
}

Json json_of(const wire::Stats& message)
{
    client::ServerStats stats;
    assign(stats, message);
    Json json = {{"session", uuid(message.session)}, {"serial", message.serial}};
    json.update(json_of(stats));
    return json;
}

Json json_of(const wire::EffectStats& message)
{
    client::EffectInfo effect;
    assign(effect, message);
    Json json = {{"session", uuid(message.session)}, {"effect", message.effect}, {"serial", message.serial}};
    json.update(json_of(effect));
    return json;
}

Json json_of(const wire::ErrorEstimate& message)
{
    client::MeasuredError error;
    assign(error, message);
    Json json = {{"session", uuid(message.session)}, {"region", message.region}, {"serial", message.serial}};
    json.update(json_of(error));
    return json;
}

Json json_of(const wire::Alarm& message)
{
    return {{"session", uuid(message.session)},
            {"name", message.name},
            {"severity", client::word_of(message.severity)},
            {"first_frame", message.first_frame},
            {"last_frame", message.last_frame},
            {"occurrences", message.occurrences},
            {"text", message.text}};
}

Json json_of(const wire::RoiState& message)
{
    client::RegionInfo region;
    assign(region, message);
    Json json = {{"session", uuid(message.session)}};
    json.update(json_of(region));
    return json;
}

Json json_of(const wire::ServerState& message)
{
    client::ServerInfo server;
    assign(server, message);
    return json_of(server);
}

Json json_of(const wire::Command& message)
{
    return {{"client", uuid(message.client)},
            {"request", message.request},
            {"session", uuid(message.session)},
            {"kind", message.kind},
            {"region", message.region},
            {"if_revision", message.if_revision},
            {"lease_s", message.lease_s},
            {"frames", message.frames},
            {"centre", vector(message.centre)},
            {"half_extent", vector(message.half_extent)},
            {"radius", message.radius},
            {"settings", assignments(message.settings)},
            {"file", message.file}};
}

Json json_of(const wire::CommandReply& message)
{
    return {{"client", uuid(message.client)},
            {"request", message.request},
            {"session", uuid(message.session)},
            {"result", client::word_of(message.result)},
            {"field", message.field},
            {"text", message.text},
            {"applied_frame", message.applied_frame},
            {"revision", message.revision}};
}

Json json_of(const wire::View& message)
{
    return {{"client", uuid(message.client)},
            {"session", uuid(message.session)},
            {"client_name", message.client_name},
            {"eye", vector(message.eye)},
            {"look_at", vector(message.look_at)},
            {"up", vector(message.up)},
            {"field_of_view_deg", message.field_of_view_deg},
            {"width_px", message.width_px},
            {"height_px", message.height_px}};
}

} // namespace slod::ctl
