#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "control/settings.hpp"
#include "core/settings.hpp"

namespace slod {

/// Kernels by the instruction set that they need.
enum class InstructionSet : std::uint8_t {
    Auto, ///< the fastest that runs on this processor
    Baseline,
    V3,
    V4,
};

/// As in simd::kernels().
constexpr std::array<std::string_view, 4> names(InstructionSet)
{
    return {"auto", "baseline", "v3", "v4"};
}

/// How the server runs a scene; the simulation's outcome does not depend on it.
struct ServerSettings {
    double frame_rate = 30;    ///< frames per second of wall time that the pacer holds
    std::uint32_t threads = 0; ///< 0: one per core
    InstructionSet isa = InstructionSet::Auto;
};

/// How the error of members' accelerations is measured while the scene runs.
struct MeterSettings {
    bool enabled = true;
    double share = 0.02; ///< of a frame's time, at most
};

/// From where on the server raises an alarm. Drifts are those of quantities that the scene conserves, since
/// the start; where it does not, a finite limit is refused.
struct AlarmSettings {
    double energy_drift = std::numeric_limits<double>::infinity();   ///< over the energy's size
    double momentum_drift = std::numeric_limits<double>::infinity(); ///< over the largest there could be
    double angular_momentum_drift = std::numeric_limits<double>::infinity(); ///< over that at the start
    double dropped_momentum = std::numeric_limits<double>::infinity(); ///< over the largest there could be
    double under_resolved = 0.1;                                       ///< share of a second's frames
    double reformed = 1;    ///< share of all particles that a frame forms anew, mean over a second
    double worn_maps = 0.1; ///< share of a second's lives of pools that ended as a map was worn
    double quarantined = 0; ///< particles since the start
};

/// What may change while the server runs a scene, besides the simulation.
struct LoopSettings {
    ServerSettings server; ///< the frame rate of it
    ControlSettings control;
    MeterSettings meter;
    AlarmSettings alarms;
};

/// What is wrong with the settings together, each with its table; empty when nothing is.
Problems problems(const LoopSettings& loop);

/// Where the wire reaches.
enum class WireProfile : std::uint8_t { Loopback, Lan };

constexpr std::array<std::string_view, 2> names(WireProfile)
{
    return {"loopback", "lan"};
}

/// What is published over DDS, and to whom.
struct WireSettings {
    bool enabled = true;
    std::uint32_t domain = 0;
    WireProfile profile = WireProfile::Loopback;
    double clusters_rate = 30;               ///< Hz, at most
    double overview_rate = 10;               ///< Hz, at most
    double stats_rate = 10;                  ///< Hz, at most
    std::uint32_t max_clusters = 262'144;    ///< per region and frame; beyond it coarser nodes are published
    std::uint32_t max_overview_nodes = 4096; ///< per frame
    bool commands = true;                    ///< clients may command
    std::uint32_t max_commands = 1024;       ///< taken at once between two frames; the rest wait
    std::uint32_t max_commanders = 256;      ///< clients whose last answers are remembered
};

template <class Visitor>
void for_each_field(ServerSettings& server, Visitor&& visit)
{
    visit(Field{"frame_rate", "Hz", "Frames per second that the server paces itself to.", 0.01, 10000},
          server.frame_rate);
    visit(Field{"threads", "", "Worker threads; 0 is one per core.", 0, 1024}, server.threads);
    visit(Field{"isa", "", "Instruction set of the kernels; auto is the fastest that runs here."},
          server.isa);
}

template <class Visitor>
void for_each_field(MeterSettings& meter, Visitor&& visit)
{
    visit(Field{"enabled", "", "Measure the error while the scene runs."}, meter.enabled);
    visit(
        Field{"share", "",
              "Share of a frame's time that it may take: of the period, or of the work where that is longer.",
              1e-4, 0.5},
        meter.share);
}

template <class Visitor>
void for_each_field(AlarmSettings& alarms, Visitor&& visit)
{
    const auto share = [&](std::string_view key, std::string_view help, double& value) {
        visit(Field{key, "", help, 0, no_maximum, true}, value);
    };
    share("energy_drift", "Change of the total energy since the start, relative; inf: none is too much.",
          alarms.energy_drift);
    share(
        "momentum_drift",
        "Change of the momentum since the start, relative to the largest of so much mass and kinetic energy.",
        alarms.momentum_drift);
    share("angular_momentum_drift", "Change of the angular momentum since the start, relative.",
          alarms.angular_momentum_drift);
    share("dropped_momentum",
          "Momentum that regions which do not attract others brought in, relative as momentum_drift.",
          alarms.dropped_momentum);
    share("under_resolved", "Share of a second's frames that would have needed more sub-steps; 1: off.",
          alarms.under_resolved);
    share("reformed", "Share of all particles that a frame forms anew, in the mean of a second; 1: off.",
          alarms.reformed);
    share("worn_maps",
          "Share of the pools formed anew in a second whose flow maps had stretched too far; 1: off.",
          alarms.worn_maps);
    share("quarantined", "Particles taken out since the start, as they left the range of numbers.",
          alarms.quarantined);
}

template <class Visitor>
void for_each_field(WireSettings& wire, Visitor&& visit)
{
    visit(Field{"enabled", "", "Publish over DDS at all."}, wire.enabled);
    visit(Field{"domain", "", "DDS domain.", 0, 230}, wire.domain);
    visit(Field{"profile", "", "loopback stays on this machine; lan is reachable from others."},
          wire.profile);
    visit(Field{"clusters_rate", "Hz", "Cluster states are published at most this often.", 0.01, 1000},
          wire.clusters_rate);
    visit(Field{"overview_rate", "Hz", "The overview is published at most this often.", 0.01, 1000},
          wire.overview_rate);
    visit(Field{"stats_rate", "Hz", "Statistics are published at most this often.", 0.01, 1000},
          wire.stats_rate);
    visit(Field{"max_clusters", "clusters",
                "Most clusters published per region and frame; beyond, coarser nodes.", 1, 4e6},
          wire.max_clusters);
    visit(Field{"max_overview_nodes", "nodes", "Most nodes of the overview.", 1, 65536},
          wire.max_overview_nodes);
    visit(Field{"commands", "", "Take commands from clients at all."}, wire.commands);
    visit(
        Field{"max_commands", "", "Most commands taken at once between two frames; the rest wait.", 1, 65536},
        wire.max_commands);
    visit(Field{"max_commanders", "",
                "Most clients whose last 64 answers are remembered, so that a retry applies once.", 1, 65536},
          wire.max_commanders);
}

} // namespace slod
