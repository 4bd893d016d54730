#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tree/merge_rules.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// Finds clusters that are to merge: in each pool, once in so many frames, each one with the nearest of those
/// that follow it in the list, `most_candidates` at most, that the region's rules let it merge with. Memory
/// is kept from frame to frame.
class Pairing {
public:
    /// A bound for pools that cannot be divided however many clusters they hold; elsewhere few have so many.
    static constexpr std::uint32_t most_candidates = 256;

    /// Provides memory for so many clusters.
    void reserve(std::size_t clusters);

    /// Puts the pairs whose pools have their turn in `frame` into `pairs`, one cluster after the other, in
    /// the order of pools and their lists. `surroundings`: by region, what its velocities are relative to.
    /// Returns how many candidates were looked at.
    std::uint64_t find(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                       std::span<const Vector3d> surroundings, std::vector<ClusterSlot>& pairs);

private:
    /// What the pools of a region are searched with.
    struct Search {
        const Subtree& tree;
        const ClusterStore& store;
        std::uint64_t frame;
        Vector3d reference;
        MergeRules rules;
    };

    std::uint64_t pair_up(const Search& search, const Pool& pool);
    ClusterSlot nearest_later(const Search& search, ClusterSlot cluster, std::uint64_t& looked_at) const;

    std::vector<ClusterSlot> partner_;     ///< by slot; of those that cannot have any, themselves
    std::vector<VelocityBall> balls_;      ///< by slot, of the others
    std::vector<std::uint64_t> looked_at_; ///< candidates, by pool in its turn
};

} // namespace slod
