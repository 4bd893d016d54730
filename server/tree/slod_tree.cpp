#include "tree/slod_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "core/powers.hpp"

namespace slod {
namespace {

const Box all_space{Vector3d::Constant(-std::numeric_limits<double>::infinity()),
                    Vector3d::Constant(std::numeric_limits<double>::infinity())};

/// Side of a region's grid cells: the maximum breadth or, when that is unlimited, a power of two that spans
/// the region, for the k-d trees to refine.
double cell_side_of(const SlodTree& tree, const RegionOfInterest& region, double max_breadth)
{
    if (std::isfinite(max_breadth))
        return max_breadth;
    const double width = greatest_width(region);
    constexpr double widest = 1e300; // whose power of two is a number yet
    if (width > widest)
        return tree.subtrees[background_row].cell_side;
    return power_of_two_above(width);
}

/// The same for a region that has cells already: where only its width asks for others, a factor of two is not
/// worth them.
double next_cell_side(const SlodTree& tree, RegionRow row, const RegionOfInterest& region, double max_breadth)
{
    const double present = tree.subtrees[row].cell_side;
    if (std::isfinite(max_breadth))
        return max_breadth;
    const double wanted = cell_side_of(tree, region, max_breadth);
    const bool near = present <= 2 * wanted && wanted <= 2 * present;
    return row == background_row || near ? present : wanted;
}

bool same_cells(const Subtree& subtree, const RegionSettings& settings, double cell_side)
{
    return subtree.cell_side == cell_side && subtree.settings.bin_by == settings.bin_by &&
           subtree.settings.bin_floor == settings.bin_floor &&
           subtree.settings.bin_ratio == settings.bin_ratio;
}

/// Puts the row's clusters into cells of another size or by other bins. Their pools are due at once.
void lay_cells_anew(SlodTree& tree, RegionRow row, const RegionSettings& settings, double cell_side,
                    ClusterTable& clusters)
{
    Subtree old(settings, row, cell_side);
    old.dithered = tree.detail.dithered;
    std::swap(old, tree.subtrees[row]);
    for (const Pool& pool : old.pools) {
        for (ClusterSlot slot = pool.node.valid() ? pool.first : ClusterSlot{}; slot.valid();) {
            const ClusterSlot next = clusters.next[slot.index];
            Subtree& subtree = tree.subtrees[row];
            link(subtree, clusters, locate_or_grow(subtree, subject_of(clusters, slot.index)), slot);
            ++tree.reinserted;
            slot = next;
        }
    }
}

/// Gives the row's subtree parameters and, where they ask for other cells, those.
void partition(SlodTree& tree, RegionRow row, const RegionOfInterest& region, ClusterTable& clusters)
{
    Subtree& subtree = tree.subtrees[row];
    const RegionSettings settings = at_detail(region.partition, tree.detail);
    subtree.dithered = tree.detail.dithered;
    const double side = next_cell_side(tree, row, region, settings.max_breadth);
    if (same_cells(subtree, settings, side)) {
        subtree.settings = settings;
    } else {
        lay_cells_anew(tree, row, settings, side, clusters);
        tree.regions[row].laid_anew = tree.unsettled = true;
    }
}

/// Notes where the region was, if this is its first change since the tree was settled.
void note_move(SlodTree& tree, RegionRow row, const Box& before)
{
    SlodTree::Region& region = tree.regions[row];
    if (!region.moved)
        region.before = before;
    region.moved = tree.unsettled = true;
}

} // namespace

SlodTree::SlodTree(const RegionSettings& background, double cell_side)
{
    subtrees.emplace_back(background, background_row, cell_side);
    Region region;
    region.number = openings++;
    region.open = true;
    region.settings.name = background_name;
    region.settings.partition = background;
    regions.push_back(region);
}

SlodTree SlodTree::with_regions_of(const SlodTree& other)
{
    const auto emptied = [](const Subtree& subtree) {
        Subtree empty(subtree.settings, subtree.region, subtree.cell_side);
        empty.dithered = subtree.dithered;
        return empty;
    };
    SlodTree tree(other.subtrees.front().settings, other.subtrees.front().cell_side);
    tree.subtrees.clear();
    std::transform(other.subtrees.begin(), other.subtrees.end(), std::back_inserter(tree.subtrees), emptied);
    tree.regions = other.regions;
    tree.detail = other.detail;
    tree.openings = other.openings;
    tree.merging = other.openings > 1 || other.detail != Detail{};
    settle(tree);
    return tree;
}

std::size_t SlodTree::pool_count() const
{
    std::size_t count = 0;
    for (const Subtree& subtree : subtrees)
        count += subtree.pool_count();
    return count;
}

std::size_t SlodTree::pool_capacity() const
{
    std::size_t capacity = 0;
    for (const Subtree& subtree : subtrees)
        capacity += subtree.pools.capacity();
    return capacity;
}

double spanning_cell_side(std::span<const Particle> particles)
{
    double extent = 0;
    for (const Particle& particle : particles)
        extent = std::max(extent, (particle.position - particles.front().position).cwiseAbs().maxCoeff());
    return power_of_two_above(extent);
}

RegionRow open_region(SlodTree& tree, const RegionOfInterest& region)
{
    std::size_t row = 1;
    while (row < tree.regions.size() && (tree.regions[row].open || tree.subtrees[row].pool_count() > 0))
        ++row;
    SLOD_ASSERT(row <= std::numeric_limits<RegionRow>::max());
    const RegionSettings settings = at_detail(region.partition, tree.detail);
    Subtree subtree(settings, RegionRow(row), cell_side_of(tree, region, settings.max_breadth));
    subtree.dithered = tree.detail.dithered;
    if (row == tree.regions.size()) {
        tree.regions.emplace_back();
        tree.subtrees.push_back(std::move(subtree));
    } else {
        tree.subtrees[row] = std::move(subtree);
    }
    const Box nowhere{all_space.upper, all_space.lower}; // meets nothing
    const Box before = tree.regions[row].moved ? tree.regions[row].before : nowhere;
    tree.regions[row] = {.settings = region, .number = tree.openings++, .open = true, .before = before};
    tree.regions[row].moved = tree.unsettled = tree.merging = true;
    return RegionRow(row);
}

void change_region(SlodTree& tree, RegionRow row, const RegionOfInterest& region, ClusterTable& clusters)
{
    SLOD_ASSERT(row < tree.regions.size() && tree.regions[row].open);
    if (row != background_row && !same_place(region, tree.regions[row].settings))
        note_move(tree, row, RegionTest(tree.regions[row].settings).bounds());
    partition(tree, row, region, clusters);
    tree.regions[row].settings = region;
}

void set_detail(SlodTree& tree, const Detail& detail, ClusterTable& clusters)
{
    tree.merging = tree.merging || detail != tree.detail;
    tree.detail = detail;
    for (std::size_t row = 0; row < tree.regions.size(); ++row)
        if (tree.regions[row].open)
            partition(tree, RegionRow(row), tree.regions[row].settings, clusters);
}

void close_region(SlodTree& tree, RegionRow row)
{
    SLOD_ASSERT(row != background_row && row < tree.regions.size() && tree.regions[row].open);
    tree.regions[row].open = false;
    note_move(tree, row, RegionTest(tree.regions[row].settings).bounds());
}

void free_closed(SlodTree& tree)
{
    for (std::size_t row = 1; row < tree.regions.size(); ++row) {
        Subtree& subtree = tree.subtrees[row];
        const auto holds_clusters = [](const Pool& pool) { return pool.node.valid() && pool.clusters > 0; };
        if (!tree.regions[row].open && subtree.pool_count() > 0 &&
            std::none_of(subtree.pools.begin(), subtree.pools.end(), holds_clusters))
            subtree = Subtree(subtree.settings, RegionRow(row), subtree.cell_side);
    }
}

void release_velocities(const SlodTree& tree, ClusterTable& clusters)
{
    for_each_block(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot)
            if (clusters.alive(slot) &&
                tree.subtrees[clusters.region[slot]].settings.cluster_velocity == ClusterVelocity::Mean)
                release_velocity(clusters, slot);
    });
}

PoolRef locate(const SlodTree& tree, const Subject& subject)
{
    const RegionRow region = tree.region_at(subject);
    return {region, locate(tree.subtrees[region], subject)};
}

PoolRef locate_or_grow(SlodTree& tree, const Subject& subject)
{
    const RegionRow region = tree.region_at(subject);
    Subtree& subtree = tree.subtrees[region];
    const std::size_t cells = subtree.cells.size();
    const PoolRef pool{region, locate_or_grow(subtree, subject)};
    if (subtree.cells.size() > cells) {
        Node& root = subtree.nodes[tree.pool(pool).node.index];
        root.contested = tree.index.contested(root.box, region);
    }
    return pool;
}

Problems problems(const SlodTree& tree, const ClusterTable& clusters)
{
    Problems found;
    std::size_t listed = 0;
    for (const Subtree& subtree : tree.subtrees) {
        const Problems of_subtree = problems(subtree, clusters);
        found.insert(found.end(), of_subtree.begin(), of_subtree.end());
        for (const Pool& pool : subtree.pools)
            if (pool.node.valid())
                listed += pool.clusters;
    }
    if (listed != clusters.alive_count())
        found.push_back(std::to_string(clusters.alive_count()) + " clusters are alive but " +
                        std::to_string(listed) + " are in pools");
    return found;
}

} // namespace slod
