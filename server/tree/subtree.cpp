#include "tree/subtree.hpp"

#include <algorithm>
#include <cmath>

#include "core/assert.hpp"

namespace slod {
namespace {

constexpr int deepest = 64;
constexpr std::uint32_t smallest_pool = 16;
/// Shares of the maximum size, where dithered: the least at which clusters are split, and to which they grow.
constexpr double least_split = 0.8, grown = 0.75;

NodeId take_node_pair(Subtree& tree)
{
    if (tree.free_node_pairs.empty()) {
        const NodeId pair{std::uint32_t(tree.nodes.size())};
        tree.nodes.resize(tree.nodes.size() + 2);
        return pair;
    }
    const NodeId pair = tree.free_node_pairs.back();
    tree.free_node_pairs.pop_back();
    return pair;
}

NodeId take_root(Subtree& tree)
{
    if (tree.free_roots.empty()) {
        tree.nodes.emplace_back();
        return {std::uint32_t(tree.nodes.size() - 1)};
    }
    const NodeId root = tree.free_roots.back();
    tree.free_roots.pop_back();
    return root;
}

/// A turn that spreads pools evenly over the frames: multiplication by the golden ratio (Knuth 1998).
std::uint32_t phase_of(PoolId pool)
{
    return (pool.index * 0x9E3779B9U) >> 16;
}

PoolId take_pool(Subtree& tree, NodeId leaf)
{
    if (tree.free_pools.empty()) {
        tree.pools.emplace_back();
        tree.free_pools.push_back({std::uint32_t(tree.pools.size() - 1)});
    }
    const PoolId pool = tree.free_pools.back();
    tree.free_pools.pop_back();
    tree.pools[pool.index] = Pool{.node = leaf, .first = {}, .phase = phase_of(pool)};
    tree.nodes[leaf.index].pool = pool;
    return pool;
}

void free_pool(Subtree& tree, PoolId pool)
{
    SLOD_ASSERT(tree.pools[pool.index].clusters == 0);
    tree.pools[pool.index].node = {};
    tree.free_pools.push_back(pool);
}

void count(std::uint64_t* visited)
{
    if (visited != nullptr)
        ++*visited;
}

/// The leaf below `node`, which itself has been counted already.
PoolId descend(const Subtree& tree, NodeId node, const Vector3d& x, std::uint64_t* visited)
{
    while (!tree.nodes[node.index].leaf()) {
        const Node& inner = tree.nodes[node.index];
        node = x[inner.axis] < inner.split ? inner.left : inner.right();
        count(visited);
    }
    return tree.nodes[node.index].pool;
}

/// Moves all clusters of one pool to another.
void move_clusters(Subtree& tree, ClusterTable& clusters, PoolId from, PoolId to)
{
    while (tree.pools[from.index].first.valid()) {
        const ClusterSlot slot = tree.pools[from.index].first;
        unlink(tree, clusters, slot);
        link(tree, clusters, to, slot);
    }
}

NodeId sibling_of(const Subtree& tree, NodeId node)
{
    const Node& parent = tree.nodes[tree.nodes[node.index].parent.index];
    return parent.left == node ? parent.right() : parent.left;
}

/// Makes the parent of two leaves a leaf, with `kept` as its pool.
void merge_leaves(Subtree& tree, ClusterTable& clusters, PoolId kept, PoolId given_up)
{
    const NodeId parent = tree.nodes[tree.pools[kept.index].node.index].parent;
    move_clusters(tree, clusters, given_up, kept);
    free_pool(tree, given_up);
    tree.free_node_pairs.push_back(tree.nodes[parent.index].left);
    tree.nodes[parent.index].left = {};
    tree.nodes[parent.index].pool = kept;
    tree.pools[kept.index].node = parent;
}

/// Bins grow by a constant ratio from the floor on; products, as the C library's logarithms differ.
std::int32_t bin_of(const RegionSettings& settings, const Subject& subject)
{
    double value = 0;
    switch (settings.bin_by) {
    case BinBy::None:
        return 0;
    case BinBy::Mass:
        value = subject.mass;
        break;
    case BinBy::Speed:
        value = subject.speed;
        break;
    case BinBy::Acceleration:
        value = subject.acceleration;
        break;
    }
    std::int32_t bin = 0;
    for (double edge = settings.bin_floor; value >= edge && bin < most_bins; edge *= settings.bin_ratio)
        ++bin;
    return bin;
}

} // namespace

Subtree::Subtree(const RegionSettings& region_settings, std::uint16_t region_index, double grid_cell_side)
    : settings(region_settings), region(region_index), cell_side(grid_cell_side)
{
    SLOD_ASSERT(cell_side > 0 && std::isfinite(cell_side));
}

std::uint32_t Subtree::max_cluster_size() const
{
    return std::uint32_t(dithered ? std::ceil(settings.max_cluster_size) : settings.max_cluster_size);
}

std::uint32_t Subtree::growth_limit() const
{
    return dithered ? std::max(std::uint32_t(grown * settings.max_cluster_size), 1U) : max_cluster_size();
}

double Subtree::split_size(std::uint64_t formation) const
{
    if (!dithered)
        return max_cluster_size();
    // Multiples of the golden ratio, by their fractions, are spread evenly (Weyl).
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15;
    const double fraction = std::ldexp(double((formation * golden_ratio) >> 11), -53);
    return std::max(settings.max_cluster_size * (least_split + (1 - least_split) * fraction), 1.0);
}

std::uint32_t Subtree::pool_limit() const
{
    return std::max(smallest_pool, std::uint32_t(settings.pool_factor * settings.max_cluster_size));
}

void reserve(Subtree& tree, std::size_t pools)
{
    const std::size_t needed = tree.pool_count() + pools;
    if (needed <= tree.pools.capacity())
        return;
    const std::size_t room = needed + needed / 2;
    tree.pools.reserve(room);
    tree.free_pools.reserve(room);
    tree.nodes.reserve(3 * room); // a root and a pair of nodes for each at most
    tree.free_roots.reserve(room);
    tree.free_node_pairs.reserve(room);
    tree.cells.reserve(room);
}

Subject subject_of(const ClusterTable& clusters, std::size_t slot)
{
    return {clusters.position[slot], clusters.mass(slot) / clusters.count[slot],
            clusters.velocity[slot].norm(),
            clusters.columns.acceleration ? clusters.acceleration[slot].norm() : 0.0};
}

Cell cell_of(const Subtree& tree, const Subject& subject)
{
    // What is farther out shares the cells at the rim.
    constexpr double rim = 1 << 30;
    const auto coordinate = [&](double value) {
        double cell = std::floor(value / tree.cell_side);
        // The quotient was rounded; what decides is the box, whose faces are at multiples of the side.
        if (value < cell * tree.cell_side)
            --cell;
        else if (value >= (cell + 1) * tree.cell_side)
            ++cell;
        return cell > -rim ? std::int32_t(std::min(cell, rim))
                           : std::int32_t(-rim); // as is what is no number
    };
    const Vector3d& x = subject.position;
    return {coordinate(x.x()), coordinate(x.y()), coordinate(x.z()), bin_of(tree.settings, subject)};
}

PoolId locate(const Subtree& tree, const Subject& subject, std::uint64_t* visited)
{
    const NodeId root = tree.cells.find(cell_of(tree, subject));
    if (!root.valid())
        return {};
    count(visited);
    return descend(tree, root, subject.position, visited);
}

PoolId locate_near(const Subtree& tree, PoolId start, const Subject& subject, std::uint64_t* visited)
{
    NodeId node = tree.pools[start.index].node;
    if (tree.nodes[node.index].bin != bin_of(tree.settings, subject))
        return locate(tree, subject, visited);
    while (node.valid()) {
        count(visited);
        if (tree.nodes[node.index].box.contains(subject.position))
            return descend(tree, node, subject.position, visited);
        node = tree.nodes[node.index].parent;
    }
    return locate(tree, subject, visited);
}

PoolId locate_or_grow(Subtree& tree, const Subject& subject)
{
    if (const PoolId found = locate(tree, subject); found.valid())
        return found;
    const Cell cell = cell_of(tree, subject);
    const NodeId root = take_root(tree);
    const Vector3d corner(cell.x, cell.y, cell.z);
    Node& node = tree.nodes[root.index];
    node = {};
    node.box = {tree.cell_side * corner, tree.cell_side * (corner + Vector3d::Ones())};
    node.bin = cell.bin;
    tree.cells.insert(cell, root);
    return take_pool(tree, root);
}

bool holds(const Subtree& tree, PoolId pool, const Subject& subject)
{
    const Node& leaf = tree.nodes[tree.pools[pool.index].node.index];
    return leaf.box.contains(subject.position) && leaf.bin == bin_of(tree.settings, subject);
}

bool can_expand(const Subtree& tree, PoolId pool)
{
    const Node& leaf = tree.nodes[tree.pools[pool.index].node.index];
    const double thinnest = std::max(1e-9 * tree.cell_side, 1e-12 * leaf.box.lower.cwiseAbs().maxCoeff());
    return leaf.depth < deepest && leaf.box.size().maxCoeff() > thinnest;
}

PoolId expand(Subtree& tree, ClusterTable& clusters, PoolId pool, int axis, double position)
{
    const NodeId leaf = tree.pools[pool.index].node;
    const NodeId pair = take_node_pair(tree);
    Node& parent = tree.nodes[leaf.index];
    SLOD_ASSERT(parent.leaf() && parent.box.lower[axis] < position && position < parent.box.upper[axis]);
    Node child;
    child.box = parent.box;
    child.parent = leaf;
    child.depth = parent.depth + 1;
    child.bin = parent.bin;
    child.contested = parent.contested;
    tree.nodes[pair.index] = tree.nodes[pair.index + 1] = child;
    tree.nodes[pair.index].box.upper[axis] = position;
    tree.nodes[pair.index + 1].box.lower[axis] = position;
    parent.left = pair;
    parent.axis = axis;
    parent.split = position;
    parent.pool = {};

    tree.nodes[pair.index].pool = pool;
    const PoolId right = take_pool(tree, {pair.index + 1});
    Pool& old_pool = tree.pools[pool.index];
    old_pool.node = pair;
    tree.pools[right.index].phase = old_pool.phase;
    tree.pools[right.index].turn_frame = old_pool.turn_frame;
    tree.pools[right.index].due_frame = old_pool.due_frame;

    for (ClusterSlot slot = old_pool.first; slot.valid();) {
        const ClusterSlot next = clusters.next[slot.index];
        if (clusters.position[slot.index][axis] >= position) {
            unlink(tree, clusters, slot);
            link(tree, clusters, right, slot);
        }
        slot = next;
    }
    return right;
}

double split_position(const Box& box, int axis, double wanted)
{
    const double margin = 0.2 * box.size()[axis];
    return std::clamp(wanted, box.lower[axis] + margin, box.upper[axis] - margin);
}

void take_own_turn(Subtree& tree, PoolId pool)
{
    tree.pools[pool.index].phase = phase_of(pool);
}

PoolId prune(Subtree& tree, ClusterTable& clusters, PoolId pool, std::uint32_t members)
{
    for (;;) {
        const NodeId node = tree.pools[pool.index].node;
        if (!tree.nodes[node.index].parent.valid())
            break;
        const NodeId sibling = sibling_of(tree, node);
        if (!tree.nodes[sibling.index].leaf())
            return pool;
        const PoolId other = tree.nodes[sibling.index].pool;
        if (tree.pools[pool.index].members + tree.pools[other.index].members >= members)
            return pool;
        merge_leaves(tree, clusters, pool, other);
    }
    if (tree.pools[pool.index].clusters > 0)
        return pool;
    const NodeId root = tree.pools[pool.index].node;
    const Box& box = tree.nodes[root.index].box;
    Cell cell = cell_of(tree, Vector3d(0.5 * (box.lower + box.upper)));
    cell.bin = tree.nodes[root.index].bin;
    tree.cells.erase(cell);
    tree.free_roots.push_back(root);
    tree.nodes[root.index].pool = {};
    free_pool(tree, pool);
    return {};
}

void link(Subtree& tree, ClusterTable& clusters, PoolId pool_id, ClusterSlot slot)
{
    Pool& pool = tree.pools[pool_id.index];
    clusters.pool[slot.index] = pool_id;
    clusters.region[slot.index] = tree.region;
    clusters.previous[slot.index] = {};
    clusters.next[slot.index] = pool.first;
    if (pool.first.valid())
        clusters.previous[pool.first.index] = slot;
    pool.first = slot;
    ++pool.clusters;
    pool.members += clusters.count[slot.index];
}

void unlink(Subtree& tree, ClusterTable& clusters, ClusterSlot slot)
{
    Pool& pool = tree.pools[clusters.pool[slot.index].index];
    const ClusterSlot next = clusters.next[slot.index];
    const ClusterSlot previous = clusters.previous[slot.index];
    if (next.valid())
        clusters.previous[next.index] = previous;
    if (previous.valid())
        clusters.next[previous.index] = next;
    else
        pool.first = next;
    --pool.clusters;
    pool.members -= clusters.count[slot.index];
}

} // namespace slod
