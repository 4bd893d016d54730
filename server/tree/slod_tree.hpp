#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cluster/particles.hpp"
#include "tree/detail.hpp"
#include "tree/region_index.hpp"
#include "tree/subtree.hpp"

namespace slod {

/// A pool of any region.
struct PoolRef {
    RegionRow region = background_row;
    PoolId pool;

    bool valid() const { return pool.valid(); }
    friend constexpr bool operator==(const PoolRef&, const PoolRef&) = default;
};

/// The master node: a subtree for each region of interest, in rows that are used again, and the order of
/// precedence among them. Row 0 is the background, which takes whatever no other region holds (O'Brien et
/// al. 2001, section 4.3).
struct SlodTree {
    /// A row's region.
    struct Region {
        RegionOfInterest settings; ///< as asked for; the subtree has them at the tree's detail
        std::uint64_t number = 0;  ///< of its opening, never used again: the earlier of equals takes
        bool open = false;         ///< closed ones give their clusters away and are empty after an update
        bool moved = false;        ///< it came, went or changed its place since settle()
        bool laid_anew = false;    ///< its cells did
        Box before;                ///< where it was at the last settle(), when it has moved
    };

    /// With nothing but the background.
    SlodTree(const RegionSettings& background, double cell_side);

    /// With the regions of another one, in their rows, as they are or were about to be, and no clusters.
    /// Whether the scene wants merges is the caller's to say again.
    static SlodTree with_regions_of(const SlodTree& other);

    std::vector<Subtree> subtrees; ///< by row
    std::vector<Region> regions;   ///< by row
    RegionIndex index;             ///< of the open ones
    Detail detail;                 ///< of all regions
    std::uint64_t openings = 0;    ///< regions opened so far
    std::uint64_t reinserted = 0;  ///< clusters put into cells anew so far
    bool unsettled = false;        ///< a region changed since settle()
    /// Clusters that move alike merge: where the scene says so, and from the first region of interest or
    /// change of detail on, as what those made small is to grow again. Never taken back.
    bool merging = false;

    Subtree& of(const PoolRef& ref) { return subtrees[ref.region]; }
    const Subtree& of(const PoolRef& ref) const { return subtrees[ref.region]; }
    Pool& pool(const PoolRef& ref) { return of(ref).pools[ref.pool.index]; }
    const Pool& pool(const PoolRef& ref) const { return of(ref).pools[ref.pool.index]; }

    /// The region that takes the subject.
    RegionRow region_at(const Subject& subject) const { return index.find(subject); }

    std::size_t pool_count() const;
    std::size_t pool_capacity() const; ///< of all regions, without taking memory
};

/// Side of grid cells without a maximum breadth: a power of two that spans the particles from the first one,
/// for the k-d trees to refine.
double spanning_cell_side(std::span<const Particle> particles);

/// Opens a region in a free row. It takes clusters from the next update on; settle() before that.
RegionRow open_region(SlodTree& tree, const RegionOfInterest& region);

/// Gives an open region, or the background, a new place or new parameters. When its grid's cells change, all
/// its clusters are put into cells anew.
void change_region(SlodTree& tree, RegionRow row, const RegionOfInterest& region, ClusterTable& clusters);

/// Gives all regions another detail. Clusters follow in the updates to come, but where a grid's cells change:
/// there they are put into cells anew.
void set_detail(SlodTree& tree, const Detail& detail, ClusterTable& clusters);

/// Closes an open region; what it holds is for others to take.
void close_region(SlodTree& tree, RegionRow row);

/// Makes changed regions count: brings the index and the cells' marks up to date, and ends the lives of the
/// pools where something changed. However often a region changed, where it was and is counts. Returns how
/// often a cell or node was compared with a change, which is what it costs.
std::uint64_t settle(SlodTree& tree);

/// Frees the rows of closed regions that hold nothing any more.
void free_closed(SlodTree& tree);

PoolRef locate(const SlodTree& tree, const Subject& subject);   ///< invalid when the cell is not there
PoolRef locate_or_grow(SlodTree& tree, const Subject& subject); ///< makes it

/// Gives the clusters that have left the regions where they move by their first particle's velocity their
/// members' mean velocity, and so the exact momentum.
void release_velocities(const SlodTree& tree, ClusterTable& clusters);

/// What one update did.
struct UpdateCounts {
    std::uint64_t due_pools = 0;        ///< pools whose clusters were re-formed
    std::uint64_t worn_pools = 0;       ///< of them: before their time, as a map had become too large
    std::uint64_t reformed_members = 0; ///< members mapped out and formed anew
    std::uint64_t strays_inserted = 0;  ///< re-formed members that joined a living cluster
    std::uint64_t strays_founding = 0;  ///< re-formed members that started a cluster in a pool not due
    std::uint64_t stray_tests = 0;      ///< clusters that strays were compared with
    std::uint64_t crossings = 0;        ///< clusters that moved to another pool
    std::uint64_t reinserted = 0;       ///< clusters put into cells of another size or binning
    std::uint64_t splits = 0;           ///< clusters split for size, breadth or drift
    std::uint64_t merges = 0;
    std::uint64_t split_keys = 0;     ///< clusters looked at for the medians that crowded leaves are split at
    std::uint64_t pair_tests = 0;     ///< candidates looked at for clusters that may merge
    std::uint64_t nodes_searched = 0; ///< k-d nodes looked at for clusters that left their leaf or region
    std::uint64_t boundary_tests = 0; ///< regions asked whether they hold a cluster
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
