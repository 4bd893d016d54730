#include "common/messages.hpp"

#include <algorithm>

#include "idl/topics.hpp"

namespace slod::client {

namespace {

template <class Sequence, class Element>
void copy(std::vector<Element>& to, const Sequence& from)
{
    const auto elements = wire::span_of(from);
    to.assign(elements.begin(), elements.end());
}

std::array<double, 3> array_of(const slod_v1_Vector& from)
{
    return {from.x, from.y, from.z};
}

Conserved conserved_of(const slod_v1_ConservedQuantities& from)
{
    return {.mass = from.mass,
            .momentum = array_of(from.momentum),
            .angular_momentum = array_of(from.angular_momentum),
            .kinetic_energy = from.kinetic_energy,
            .potential_energy = from.potential_energy};
}

} // namespace

bool ServerInfo::takes_commands() const
{
    return std::find(topics.begin(), topics.end(), wire::topic<wire::Command>().name) != topics.end();
}

void assign(ServerInfo& to, const wire::ServerState& from)
{
    to.session = wire::uuid_of(from.session);
    to.heartbeat = from.heartbeat;
    to.frame = from.frame;
    to.time = from.time;
    to.idle_ms = from.idle_ms;
    to.paused = from.paused;
    to.frame_rate_target_hz = from.frame_rate_target_hz;
    to.frame_rate_hz = from.frame_rate_hz;
    to.real_time_factor = from.real_time_factor;
    to.particles = from.particles;
    to.regions = from.regions;
    to.alarms = from.alarms;
    to.max_sample_bytes = from.max_sample_bytes;
    to.length_m = from.units.length_m;
    to.mass_kg = from.units.mass_kg;
    to.time_s = from.units.time_s;
    to.time_step = from.time_step;
    to.scene_title = from.scene_title;
    to.version = from.version;
    to.isa = from.isa;
    to.threads = from.threads;
    to.host = from.host;
    to.process = from.process;
    to.started_ns = from.started_ns;
    to.topics.clear();
    for (const slod_v1_TopicName& topic : wire::span_of(from.topics))
        to.topics.emplace_back(topic.name);
}

void assign(MeasuredError& to, const wire::ErrorEstimate& from)
{
    const auto quantile = [](const slod_v1_EstimatedQuantile& field) -> Quantile {
        return {field.value, field.low, field.high};
    };
    to = {.frame = from.frame,
          .oldest_frame = from.oldest_frame,
          .newest_frame = from.newest_frame,
          .samples = from.samples,
          .median = quantile(from.median),
          .p90 = quantile(from.p90),
          .p99 = quantile(from.p99),
          .max = from.max,
          .rms = from.rms,
          .target = from.target};
}

void assign(EffectInfo& to, const wire::EffectStats& from)
{
    to = {.frame = from.frame,
          .state = from.state,
          .acts_on_clusters = from.acts_on_clusters,
          .clusters = from.clusters,
          .particles = from.particles,
          .straddling = from.straddling,
          .ms = from.ms};
}

void assign(ServerStats& to, const wire::Stats& from)
{
    to.frame = from.frame;
    to.time = from.time;
    to.frame_rate_hz = from.frame_rate_hz;
    to.work_ms = from.work_ms;
    to.real_time_factor = from.real_time_factor;
    to.particles = from.particles;
    to.clusters = from.clusters;
    to.phases_ms.clear();
    for (const slod_v1_PhaseTime& phase : wire::span_of(from.phases))
        to.phases_ms.emplace_back(phase.name, phase.ms);
    to.counts.clear();
    for (const slod_v1_NamedCount& count : wire::span_of(from.counts))
        to.counts.emplace_back(count.name, count.count);
    to.conserved_measured = from.conserved_measured;
    to.conserved = conserved_of(from.conserved);
    to.drift = conserved_of(from.drift);
    to.control = {.mode = from.control.mode,
                  .state = from.control.state,
                  .target_ms = from.control.target_ms,
                  .decisions = from.control.decisions,
                  .cluster_size = from.control.cluster_size,
                  .breadth = from.control.breadth,
                  .opening = from.control.opening,
                  .life = from.control.life};
    to.wire = from.wire;
}

void assign(RegionInfo& to, const wire::RoiState& from)
{
    to.region = from.region;
    to.revision = from.revision;
    to.partition = from.partition;
    to.shape = from.shape;
    to.centre = array_of(from.centre);
    to.half_extent = array_of(from.half_extent);
    to.radius = from.radius;
    to.direction = array_of(from.direction);
    to.up = array_of(from.up);
    to.field_of_view_deg = from.field_of_view_deg;
    to.aspect = from.aspect;
    to.near_distance = from.near_distance;
    to.far_distance = from.far_distance;
    to.follows = from.follows;
    to.precedence = from.precedence;
    to.max_cluster_size = from.max_cluster_size;
    to.max_breadth = from.max_breadth;
    to.present_max_cluster_size = from.present_max_cluster_size;
    to.present_max_breadth = from.present_max_breadth;
    to.settings.clear();
    for (const wire::Assignment& assignment : wire::span_of(from.settings))
        to.settings.emplace_back(assignment.setting, assignment.value);
    to.owner = wire::uuid_of(from.owner);
    to.lease_s = from.lease_s;
    to.clusters = from.clusters;
    to.particles = from.particles;
}

void assign(RegionClusters& to, const wire::Clusters& from)
{
    to.region = from.region;
    to.frame = from.frame;
    to.time = from.time;
    to.region_clusters = from.region_clusters;
    to.clusters_per_node = from.clusters_per_node;
    to.origin = array_of(from.origin);
    copy(to.position, from.position);
    copy(to.velocity, from.velocity);
    copy(to.mass, from.mass);
    copy(to.particles, from.particles);
    copy(to.covariance, from.covariance);
    copy(to.cluster_id, from.cluster_id);
    copy(to.formation, from.formation);
}

void assign(OverviewNodes& to, const wire::Overview& from)
{
    to.frame = from.frame;
    to.time = from.time;
    to.scene_clusters = from.scene_clusters;
    to.clusters_per_node = from.clusters_per_node;
    to.origin = array_of(from.origin);
    copy(to.position, from.position);
    copy(to.velocity, from.velocity);
    copy(to.mass, from.mass);
    copy(to.particles, from.particles);
    copy(to.radius, from.radius);
}

} // namespace slod::client
