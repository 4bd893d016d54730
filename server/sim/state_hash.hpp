#pragma once

#include <cstdint>
#include <span>

#include "cluster/forming.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// What of the simulation's state is outside the clusters and the tree.
struct RunState {
    std::uint64_t frame = 0;
    std::span<const std::uint64_t> random_counters; ///< particles started, by emitter
    std::span<const ClusterId> cohorts;             ///< which newborns may join, by emitter
};

/// Covers centres, velocities, maps, moments, members, masses, ids, the tree with its regions' settings, the
/// pools' turns and whether clusters merge, the emitters' open clusters and the random counters, bit by bit
/// (XXH3). The rows of clusters, pools and nodes enter, as later frames go by their order; what free rows
/// hold and where slabs are does not.
std::uint64_t hash_state(const ClusterStore& store, const SlodTree& tree, const RunState& run);

} // namespace slod
