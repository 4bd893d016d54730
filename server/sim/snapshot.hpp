#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "cluster/conserved.hpp"
#include "core/ids.hpp"
#include "core/vectors.hpp"
#include "effects/collisions.hpp"
#include "effects/draining.hpp"
#include "effects/fields/field_set.hpp"
#include "effects/switches.hpp"
#include "sim/phase.hpp"
#include "sim/quarantine.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// What happened in one frame, counted.
struct FrameCounts : UpdateCounts, CollisionCounts {
    std::uint64_t particles = 0; ///< alive at the end of the frame
    std::uint64_t clusters = 0;
    std::uint64_t pools = 0;
    std::uint64_t born = 0;
    std::uint64_t births_refused = 0; ///< there are as many particles as the scene may have
    std::uint64_t died = 0;
    std::uint64_t drained = 0;      ///< of those that died: in sinks
    std::uint64_t kicked = 0;       ///< particles whose velocity was changed by itself
    std::uint64_t interactions = 0; ///< pairs of a cluster with another one or with a node, summed by gravity
    std::uint64_t far_nodes = 0;    ///< that act on many clusters at once, by an expansion
    std::uint64_t walks = 0;        ///< of the tree, each for a group of clusters
    std::uint64_t nodes_tested = 0; ///< in those walks, whether they may act as one body
    std::uint64_t error_pairs = 0;  ///< of a particle and a member whose error is measured
    std::uint64_t quarantined = 0;  ///< particles that left the range of numbers, of those that died
    std::uint64_t substeps = 0;
    std::uint64_t under_resolved = 0; ///< 1: tides asked for more sub-steps than the scene allows
    FieldCounts fields{};             ///< by effect of place, in the order of their list; 0 for absent ones
};

/// A count of events in a frame, by name.
struct EventCount {
    std::string_view name;
    std::uint64_t FrameCounts::*count;
};

/// The only list of them, besides that of effects of place. The other counts (particles, clusters, pools) are
/// levels: their sum over frames means nothing.
inline constexpr std::array<EventCount, 32> event_counts{{
    {"born", &FrameCounts::born},
    {"births_refused", &FrameCounts::births_refused},
    {"died", &FrameCounts::died},
    {"drained", &FrameCounts::drained},
    {"struck", &FrameCounts::struck},
    {"taken_apart", &FrameCounts::taken_apart},
    {"impacts", &FrameCounts::impacts},
    {"impacts_cut_off", &FrameCounts::impacts_cut_off},
    {"killed", &FrameCounts::killed},
    {"kicked", &FrameCounts::kicked},
    {"due_pools", &FrameCounts::due_pools},
    {"worn_pools", &FrameCounts::worn_pools},
    {"reformed_members", &FrameCounts::reformed_members},
    {"strays_inserted", &FrameCounts::strays_inserted},
    {"strays_founding", &FrameCounts::strays_founding},
    {"stray_tests", &FrameCounts::stray_tests},
    {"crossings", &FrameCounts::crossings},
    {"reinserted", &FrameCounts::reinserted},
    {"splits", &FrameCounts::splits},
    {"merges", &FrameCounts::merges},
    {"split_keys", &FrameCounts::split_keys},
    {"pair_tests", &FrameCounts::pair_tests},
    {"nodes_searched", &FrameCounts::nodes_searched},
    {"boundary_tests", &FrameCounts::boundary_tests},
    {"interactions", &FrameCounts::interactions},
    {"far_nodes", &FrameCounts::far_nodes},
    {"walks", &FrameCounts::walks},
    {"nodes_tested", &FrameCounts::nodes_tested},
    {"error_pairs", &FrameCounts::error_pairs},
    {"quarantined", &FrameCounts::quarantined},
    {"substeps", &FrameCounts::substeps},
    {"under_resolved", &FrameCounts::under_resolved},
}};

/// Calls visit(name, count) for all of them; of each effect of place, by its name, for the clusters that it
/// was evaluated for, and by straddling_name() for those that its boundary cut.
template <class Visitor>
void for_each_event(const FrameCounts& counts, Visitor&& visit)
{
    for (const EventCount& event : event_counts)
        visit(event.name, counts.*event.count);
    std::size_t row = 0;
    for_each_field_table(FieldSettings{}, [&]<class F>(const typename F::Table&) {
        visit(F::name, counts.fields[row].clusters);
        if constexpr (HasBoundary<F>)
            visit(straddling_name<F>(), counts.fields[row].straddling);
        ++row;
    });
}

/// Adds the events of a frame to those of others.
inline void add_events(FrameCounts& sum, const FrameCounts& frame)
{
    for (const EventCount& event : event_counts)
        sum.*event.count += frame.*event.count;
    for (std::size_t row = 0; row < sum.fields.size(); ++row)
        sum.fields[row] += frame.fields[row];
}

/// What an effect did in a frame.
struct EffectWork {
    std::uint64_t clusters = 0;  ///< acted on, once for each element of its table
    std::uint64_t particles = 0; ///< acted on one by one
    /// Clusters that the boundary of an effect of place cuts, once for each element of its table: all members
    /// follow it as it is at the centre.
    std::uint64_t straddling = 0;
    /// Wall time, of all threads together where an effect of place is meant. What several do in one pass,
    /// speed_limit and brownian, counts for each; what is propagated exactly, for none.
    double ms = 0;
};

/// The clusters at the end of a frame, one array per quantity, all of the same length: what is
/// published, drawn and tested. Empty unless somebody asked for it in that frame.
struct ClusterStates {
    std::vector<Vector3d> position; ///< centre of mass, scene length
    std::vector<Vector3d> velocity; ///< scene length / time
    std::vector<double> mass;
    std::vector<std::uint32_t> count;             ///< particles
    std::vector<std::array<float, 6>> covariance; ///< of positions: xx xy xz yy yz zz, scene length^2
    std::vector<ClusterId> id;
    std::vector<std::uint64_t> formation; ///< never re-used: a new one for every forming
    std::vector<std::uint16_t> region;    ///< index of the region of interest

    std::size_t size() const { return position.size(); }
    void clear(); ///< keeps the memory
};

/// What a region of interest holds.
struct RegionLoad {
    RegionRow row;
    std::uint64_t clusters, particles;
    double max_cluster_size, max_breadth; ///< at the present detail; particles, scene length

    friend bool operator==(const RegionLoad&, const RegionLoad&) = default;
};

/// One frame's outcome.
struct Snapshot {
    std::uint64_t frame = 0; ///< frames completed since the start
    double time = 0;         ///< scene time at the end of the frame
    FrameCounts counts;
    ConservedQuantities conserved;
    /// Momentum per time that gravity brings in where regions do not attract those that attract them; 0
    /// otherwise.
    Vector3d unanswered_force{0, 0, 0};
    /// Of all particles in each other's gravity, in uniform gravity and in the effects of place that have
    /// one, where it was asked for. NaN else, and under the self-gravity of clusters or of more than
    /// most_pairwise particles: the sum goes over all pairs.
    double potential_energy = std::numeric_limits<double>::quiet_NaN();
    static constexpr std::size_t most_pairwise = 4096;
    Losses drained;          ///< what sinks took in this frame
    Losses killed;           ///< what colliders did, with the velocities of the impacts
    Quarantined quarantined; ///< what left the range of numbers
    StepProfile profile;     ///< of this frame
    std::array<EffectWork, effect_count> effects{}; ///< by effect_row()
    std::vector<RegionLoad> regions;                ///< in order of precedence, the background last
    Detail detail;                                  ///< that the frame was run at
    ClusterStates clusters;
};

} // namespace slod
