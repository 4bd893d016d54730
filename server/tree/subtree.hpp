#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cluster/forming.hpp"
#include "core/ids.hpp"
#include "tree/box.hpp"
#include "tree/cell_map.hpp"
#include "tree/region.hpp"
#include "tree/settings.hpp"

namespace slod {

/// A node of a cell's k-d tree. The right child follows the left one.
struct Node {
    Box box;
    NodeId parent; ///< invalid in the root of a cell
    NodeId left;   ///< invalid in a leaf
    PoolId pool;   ///< valid in a leaf
    double split = 0;
    int axis = 0;
    int depth = 0;
    std::int32_t bin = 0;  ///< of the cell
    bool contested = true; ///< another region may take part of the box

    bool leaf() const { return !left.valid(); }
    NodeId right() const { return {left.index + 1}; }
};

/// The clusters of one leaf, and when they are formed anew.
struct Pool {
    NodeId node;       ///< invalid in a free pool
    ClusterSlot first; ///< head of the list of its clusters
    std::uint32_t clusters = 0;
    std::uint32_t members = 0;
    std::uint32_t phase = 0;            ///< spreads the pools' turns over the frames
    std::uint64_t turn_frame = no_turn; ///< when its clusters were formed
    std::uint64_t due_frame = 0;        ///< when their life ends

    static constexpr std::uint64_t no_turn = std::numeric_limits<std::uint64_t>::max(); ///< still to come

    std::uint64_t life() const { return due_frame - turn_frame; } ///< frames
};

/// The subtree of one region of interest: a sparse uniform grid whose cells are no wider than the maximum
/// breadth, each cell the root of a k-d tree whose leaves are pools (O'Brien et al. 2001, section 4.2).
/// Invariants, listed by problems():
///  - the children's boxes divide their parent's; a root's box is its cell;
///  - every leaf has a pool and every pool in use a leaf; inner nodes have none;
///  - a pool's counts are those of its list, and its clusters name the pool and the region.
struct Subtree {
    Subtree(const RegionSettings& settings, std::uint16_t region_index, double grid_cell_side);

    RegionSettings settings; ///< at the tree's detail
    bool dithered = false;   ///< Detail's
    std::uint16_t region = 0;
    double cell_side = 1; ///< scene length
    CellMap cells;
    std::vector<Node> nodes;
    std::vector<Pool> pools;
    std::vector<NodeId> free_node_pairs; ///< first of two neighbouring free nodes
    std::vector<NodeId> free_roots;
    std::vector<PoolId> free_pools;

    /// In whole particles: floored or, where dithered, rounded up, as some clusters are to have one more.
    std::uint32_t max_cluster_size() const;
    /// Particles up to which clusters grow, by merging or by births.
    std::uint32_t growth_limit() const;
    /// Particles above which the cluster of this formation number is split. Where dithered, that differs from
    /// cluster to cluster: else a change of the maximum size by one would split all full ones at once, or
    /// none. Clusters then grow to less than the least of these sizes, so that none is split right after.
    double split_size(std::uint64_t formation) const;

    std::uint32_t pool_limit() const; ///< members of a pool, at most: a goal
    std::size_t pool_count() const { return pools.size() - free_pools.size(); }
};

/// Provides room for `pools` more pools, with their nodes and cells.
void reserve(Subtree& tree, std::size_t pools);

/// What regions ask of a cluster. Without the column its acceleration counts as 0.
Subject subject_of(const ClusterTable& clusters, std::size_t slot);

Cell cell_of(const Subtree& tree, const Subject& subject);

/// The pool of the subject; invalid when its cell is not there. `visited` (may be null) is raised by the
/// nodes looked at.
PoolId locate(const Subtree& tree, const Subject& subject, std::uint64_t* visited = nullptr);

/// The same, searched bottom-up from a pool nearby, and top-down from the first node that encloses the
/// subject (section 4.3).
PoolId locate_near(const Subtree& tree, PoolId start, const Subject& subject,
                   std::uint64_t* visited = nullptr);

/// The pool of the subject, whose cell is made when it is not there.
PoolId locate_or_grow(Subtree& tree, const Subject& subject);

/// Whether the pool's leaf is where the subject belongs in this subtree.
bool holds(const Subtree& tree, PoolId pool, const Subject& subject);

/// Splits a pool's leaf at `position` along `axis`; its clusters go to the side their centre is on. The
/// pool itself becomes the left one; the right one is returned, with the same turn.
PoolId expand(Subtree& tree, ClusterTable& clusters, PoolId pool, int axis, double position);

/// Where a leaf's box is split along `axis`: as near to `wanted` as keeps the parts' aspect ratio bounded,
/// which is not near a face.
double split_position(const Box& box, int axis, double wanted);

/// Gives a pool a turn of its own, unlike that of the pool it was split from.
void take_own_turn(Subtree& tree, PoolId pool);

/// Whether a leaf can be divided further: not when it has become too deep, or too thin for its cell or for
/// the resolution of its coordinates.
bool can_expand(const Subtree& tree, PoolId pool);

/// Merges the pool's leaf with its sibling while that is a leaf too and both together hold less than
/// `members`, or removes its cell when it holds nothing. Returns the pool that holds the clusters now;
/// invalid when the cell is gone.
PoolId prune(Subtree& tree, ClusterTable& clusters, PoolId pool, std::uint32_t members);

void link(Subtree& tree, ClusterTable& clusters, PoolId pool, ClusterSlot slot); ///< adds to the pool's list
void unlink(Subtree& tree, ClusterTable& clusters, ClusterSlot slot);            ///< takes it off its list

/// What breaks the invariants; empty when nothing does. O(clusters).
Problems problems(const Subtree& tree, const ClusterTable& clusters);

} // namespace slod
