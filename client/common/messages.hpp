#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "idl/messages.hpp"

/// What clients keep of the messages: their own memory, in C++ types. Meanings and units are slod.idl's.
namespace slod::client {

struct ServerInfo {
    wire::Uuid session{};
    std::uint64_t heartbeat = 0;
    std::uint64_t frame = 0;
    double time = 0;
    double idle_ms = 0;
    bool paused = false;
    double frame_rate_target_hz = 0, frame_rate_hz = 0;
    double real_time_factor = 0;
    std::uint64_t particles = 0;
    std::uint32_t regions = 0;
    std::uint32_t alarms = 0;
    std::uint64_t max_sample_bytes = 0;
    double length_m = 1, mass_kg = 1, time_s = 1;
    double time_step = 0;
    std::string scene_title;
    std::string version;
    std::string isa;
    std::uint32_t threads = 0;
    std::string host;
    std::uint32_t process = 0;
    std::int64_t started_ns = 0;
    std::vector<std::string> topics;

    bool takes_commands() const; ///< wire.commands of its scene
};

struct Conserved {
    double mass = 0;
    std::array<double, 3> momentum{};
    std::array<double, 3> angular_momentum{};
    double kinetic_energy = 0;
    double potential_energy = 0;
};

/// What holds the frame rate.
struct Control {
    std::string mode, state;
    double target_ms = 0;
    std::uint64_t decisions = 0;
    double cluster_size = 1, breadth = 1, opening = 1, life = 1;
};

struct ServerStats {
    std::uint64_t frame = 0;
    double time = 0;
    double frame_rate_hz = 0;
    double work_ms = 0;
    double real_time_factor = 0;
    std::uint64_t particles = 0;
    std::uint64_t clusters = 0;
    std::vector<std::pair<std::string, double>> phases_ms;
    std::vector<std::pair<std::string, std::uint64_t>> counts;
    bool conserved_measured = false;
    Conserved conserved, drift;
    Control control;
    wire::PublisherCounts wire{};
};

/// As EstimatedQuantile in slod.idl.
struct Quantile {
    double value = 0, low = 0, high = 0;
};

/// Errors of accelerations, relative, of members that were drawn in some of the last frames.
struct MeasuredError {
    std::uint64_t frame = 0;
    std::uint64_t oldest_frame = 0, newest_frame = 0;
    std::uint64_t samples = 0;
    Quantile median, p90, p99;
    double max = 0, rms = 0;
    double target = 0; ///< median that is held; 0: none
};

/// An effect the server's program knows, and what it did in a frame.
struct EffectInfo {
    std::uint64_t frame = 0;
    std::string state; ///< "active", "off", "powerless" or "absent"
    std::string acts_on_clusters;
    std::uint64_t clusters = 0, particles = 0, straddling = 0;
    double ms = 0;
};

/// A region of interest as it is.
struct RegionInfo {
    std::string region;
    std::uint64_t revision = 0;
    std::string partition;
    std::string shape;
    std::array<double, 3> centre{}, half_extent{};
    double radius = 0;
    std::array<double, 3> direction{}, up{};
    double field_of_view_deg = 0, aspect = 0, near_distance = 0, far_distance = 0;
    std::string follows;
    std::int32_t precedence = 0;
    double max_cluster_size = 0, max_breadth = 0;
    double present_max_cluster_size = 0, present_max_breadth = 0;
    std::vector<std::pair<std::string, std::string>> settings; ///< the other ones, values in TOML
    wire::Uuid owner{};
    double lease_s = 0;
    std::uint64_t clusters = 0, particles = 0;
};

/// Nodes of one region in one frame.
struct RegionClusters {
    std::string region;
    std::uint64_t frame = 0;
    double time = 0;
    std::uint64_t region_clusters = 0;
    std::uint32_t clusters_per_node = 1;
    std::array<double, 3> origin{};
    std::vector<float> position; ///< xyz, relative to origin
    std::vector<float> velocity; ///< xyz
    std::vector<float> mass;
    std::vector<std::uint32_t> particles;
    std::vector<float> covariance; ///< xx xy xz yy yz zz
    std::vector<std::uint64_t> cluster_id;
    std::vector<std::uint64_t> formation;
};

struct OverviewNodes {
    std::uint64_t frame = 0;
    double time = 0;
    std::uint64_t scene_clusters = 0;
    std::uint32_t clusters_per_node = 1;
    std::array<double, 3> origin{};
    std::vector<float> position; ///< xyz, relative to origin
    std::vector<float> velocity; ///< xyz
    std::vector<float> mass;
    std::vector<std::uint32_t> particles;
    std::vector<float> radius;
};

/// Copies of a message; the sequences re-use the memory of the target.
void assign(ServerInfo& to, const wire::ServerState& from);
void assign(ServerStats& to, const wire::Stats& from);
void assign(MeasuredError& to, const wire::ErrorEstimate& from);
void assign(EffectInfo& to, const wire::EffectStats& from);
void assign(RegionInfo& to, const wire::RoiState& from);
void assign(RegionClusters& to, const wire::Clusters& from);
void assign(OverviewNodes& to, const wire::Overview& from);

} // namespace slod::client
