#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tree/subtree.hpp"

namespace slod {

/// A cluster's place along the axis that a leaf is split across.
struct SplitKey {
    double coordinate;
    ClusterSlot slot;
    std::uint32_t members;
};

/// What crowded leaves of one subtree are split with: room for all its clusters in each.
struct SplitScratch {
    std::span<ClusterSlot> slots, spare;
    std::span<SplitKey> keys;
};

/// The same for all subtrees, in slices, so that they can be split in parallel.
class SplitMemory {
public:
    void reserve(std::size_t clusters);
    void resize(std::size_t clusters);
    SplitScratch slice(std::size_t first, std::size_t count);

private:
    std::vector<ClusterSlot> slots_, spare_;
    std::vector<SplitKey> keys_;
};

/// Splits the pool's leaf at the median of its members, taken at their clusters' centres, and both sides on,
/// until none that can be split has more than `limit` members. Returns how often a cluster was looked at for
/// a median, O(log n) times each.
std::uint64_t expand_crowded(Subtree& tree, ClusterTable& clusters, PoolId pool, double limit,
                             const SplitScratch& scratch);

} // namespace slod
