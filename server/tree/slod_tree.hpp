#pragma once

#include <cstdint>
#include <vector>

#include "tree/subtree.hpp"

namespace slod {

/// A pool of any region.
struct PoolRef {
    std::uint16_t region = 0;
    PoolId pool;

    bool valid() const { return pool.valid(); }
    friend constexpr bool operator==(const PoolRef&, const PoolRef&) = default;
};

/// The master node: one subtree per region of interest, in order of precedence. The last one is the
/// background, which takes whatever no other region holds (O'Brien et al. 2001, section 4.3).
struct SlodTree {
    std::vector<Subtree> subtrees;

    Subtree& of(const PoolRef& ref) { return subtrees[ref.region]; }
    const Subtree& of(const PoolRef& ref) const { return subtrees[ref.region]; }
    Pool& pool(const PoolRef& ref) { return of(ref).pools[ref.pool.index]; }
    const Pool& pool(const PoolRef& ref) const { return of(ref).pools[ref.pool.index]; }

    /// The region that takes what is at x.
    std::uint16_t region_at(const Vector3d& x) const;

    std::size_t pool_count() const;
    std::size_t pool_capacity() const; ///< of all regions, without taking memory
};

PoolRef locate(const SlodTree& tree, const Vector3d& x);   ///< invalid when the cell is not there
PoolRef locate_or_grow(SlodTree& tree, const Vector3d& x); ///< makes it

/// What one update did.
struct UpdateCounts {
    std::uint64_t due_pools = 0;        ///< pools whose clusters were re-formed
    std::uint64_t reformed_members = 0; ///< members mapped out and formed anew
    std::uint64_t strays_inserted = 0;  ///< re-formed members that joined a living cluster
    std::uint64_t strays_founding = 0;  ///< re-formed members that started a cluster in a pool not due
    std::uint64_t crossings = 0;        ///< clusters that moved to another pool
    std::uint64_t splits = 0;           ///< clusters split for size or breadth
    std::uint64_t merges = 0;
};

/// What an update works on besides the tree.
struct UpdateContext {
    ClusterStore& store;
    std::uint64_t frame; ///< frames completed at the moment of the update
    double step;         ///< time of one frame
};

/// What breaks the invariants of tree and clusters together; empty when nothing does. O(clusters).
Problems problems(const SlodTree& tree, const ClusterTable& clusters);

} // namespace slod
