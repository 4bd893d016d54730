#pragma once

#include "cluster/conserved.hpp"
#include "core/ids.hpp"
#include "core/vectors.hpp"
#include "sim/phase.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace slod {

/// What happened in one frame, counted.
struct FrameCounts {
    std::uint64_t particles = 0;         ///< alive at the end of the frame
    std::uint64_t clusters = 0;
    std::uint64_t pools = 0;
    std::uint64_t born = 0;
    std::uint64_t died = 0;
    std::uint64_t due_pools = 0;         ///< pools whose clusters were re-formed
    std::uint64_t reformed_members = 0;  ///< members mapped out and formed anew
    std::uint64_t strays_inserted = 0;   ///< re-formed members that joined a living cluster
    std::uint64_t strays_founding = 0;   ///< re-formed members that started a cluster in a pool not due
    std::uint64_t crossings = 0;         ///< clusters that moved to another pool
    std::uint64_t splits = 0;            ///< clusters split for size or breadth
    std::uint64_t merges = 0;
    std::uint64_t interactions = 0;      ///< pairs summed by gravity
};

/// Calls visit(name, member) for every count of events in a frame; the only list of them. The other
/// counts (particles, clusters, pools) are levels: summing them over frames means nothing.
template <class Counts, class Visitor>
void for_each_event(Counts& counts, Visitor&& visit)
{
    visit("born", counts.born);
    visit("died", counts.died);
    visit("due_pools", counts.due_pools);
    visit("reformed_members", counts.reformed_members);
    visit("strays_inserted", counts.strays_inserted);
    visit("strays_founding", counts.strays_founding);
    visit("crossings", counts.crossings);
    visit("splits", counts.splits);
    visit("merges", counts.merges);
    visit("interactions", counts.interactions);
}

/// The clusters at the end of a frame, one array per quantity, all of the same length: what is
/// published, drawn and tested. Filled only when somebody asks for it.
struct ClusterStates {
    std::vector<Vector3d> position;                ///< centre of mass, scene length
    std::vector<Vector3d> velocity;                ///< scene length / time
    std::vector<double> mass;
    std::vector<std::uint32_t> count;              ///< particles
    std::vector<std::array<float, 6>> covariance;  ///< of positions: xx xy xz yy yz zz, scene length^2
    std::vector<ClusterId> id;
    std::vector<std::uint64_t> formation;          ///< never re-used: a new one for every forming
    std::vector<std::uint16_t> region;             ///< index of the region of interest

    std::size_t size() const { return position.size(); }
};

/// One frame's outcome.
struct Snapshot {
    std::uint64_t frame = 0; ///< frames completed since the start
    double time = 0;         ///< scene time at the end of the frame
    FrameCounts counts;
    ConservedQuantities conserved;
    StepProfile profile;     ///< of this frame
    ClusterStates clusters;
};

} // namespace slod
