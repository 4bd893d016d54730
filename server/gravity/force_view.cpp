#include "gravity/force_view.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 512;
constexpr std::size_t deepest_path = 128; ///< nodes from the root: octants of cells, and k-d nodes in a cell

/// Spreads the low 21 bits of `value` to every third bit.
std::uint64_t spread_bits(std::uint64_t value)
{
    value &= 0x1f'ffff;
    value = (value | value << 32) & 0x001f'0000'0000'ffff;
    value = (value | value << 16) & 0x001f'0000'ff00'00ff;
    value = (value | value << 8) & 0x100f'00f0'0f00'f00f;
    value = (value | value << 4) & 0x10c3'0c30'c30c'30c3;
    return (value | value << 2) & 0x1249'2492'4924'9249;
}

/// Cells beyond 2^20 from the origin share the codes at the rim: their order suffers, nothing else.
std::uint64_t morton_code(const Cell& cell)
{
    const auto shifted = [](std::int32_t coordinate) {
        return spread_bits(std::uint64_t(std::clamp(coordinate, -(1 << 20), (1 << 20) - 1) + (1 << 20)));
    };
    return shifted(cell.x) | shifted(cell.y) << 1 | shifted(cell.z) << 2;
}

void sort_cells(std::vector<ForceView::CellRoot>& cells, const Subtree& tree)
{
    cells.clear();
    tree.cells.for_each([&](const Cell& cell, NodeId root) {
        cells.push_back({morton_code(cell), cell, root});
    });
    std::sort(cells.begin(), cells.end(), [](const ForceView::CellRoot& a, const ForceView::CellRoot& b) {
        return std::tie(a.key, a.cell) < std::tie(b.key, b.cell);
    });
}

/// Appends nodes and bodies depth first. A node that would hold nothing, or the same as its only child, is
/// left out.
class Builder {
public:
    Builder(ForceView& view, const Subtree& tree, const ClusterTable& clusters)
        : view_(view), tree_(tree), clusters_(clusters)
    {}

    /// Cells [begin, end), whose codes agree above bit 3 * level.
    void add_cells(std::size_t begin, std::size_t end, int level)
    {
        if (begin == end)
            return;
        if (end - begin == 1 || level == 0) {
            for (std::size_t cell = begin; cell < end; ++cell)
                add_tree(view_.cells[cell].root);
            return;
        }
        const std::size_t node = open();
        for (std::uint64_t octant = 0; octant < 8; ++octant) {
            std::size_t split = begin;
            while (split < end && (view_.cells[split].key >> (3 * (level - 1)) & 7) == octant)
                ++split;
            add_cells(begin, split, level - 1);
            begin = split;
        }
        close(node);
    }

private:
    std::size_t open()
    {
        view_.nodes.push_back({.first = std::uint32_t(view_.slot.size())});
        return view_.nodes.size() - 1;
    }

    void close(std::size_t node)
    {
        ForceView::Node& closed = view_.nodes[node];
        closed.count = std::uint32_t(view_.slot.size()) - closed.first;
        closed.next = std::uint32_t(view_.nodes.size());
        const bool doubled = view_.nodes.size() > node + 1 && view_.nodes[node + 1].count == closed.count;
        if (closed.count == 0) {
            view_.nodes.resize(node);
        } else if (doubled) {
            view_.nodes.erase(view_.nodes.begin() + std::ptrdiff_t(node));
            for (std::size_t below = node; below < view_.nodes.size(); ++below)
                --view_.nodes[below].next;
        }
    }

    void add_tree(NodeId id)
    {
        const std::size_t opened = open();
        const Node& node = tree_.nodes[id.index];
        if (node.leaf()) {
            const Pool& pool = tree_.pools[node.pool.index];
            for (ClusterSlot slot = pool.first; slot.valid(); slot = clusters_.next[slot.index])
                view_.slot.push_back(slot);
        } else {
            add_tree(node.left);
            add_tree(node.right());
        }
        close(opened);
    }

    ForceView& view_;
    const Subtree& tree_;
    const ClusterTable& clusters_;
};

void fill_bodies(ForceView& view, const ClusterTable& clusters, const GravitySettings& gravity)
{
    const std::size_t count = view.body_count();
    for (auto* column : {&view.x, &view.y, &view.z, &view.mass, &view.q})
        column->resize(count);
    for_each_block(count, block, [&](std::size_t first, std::size_t last) {
        for (std::size_t body = first; body < last; ++body) {
            const std::size_t slot = view.slot[body].index;
            view.x[body] = clusters.position[slot].x();
            view.y[body] = clusters.position[slot].y();
            view.z[body] = clusters.position[slot].z();
            view.mass[body] = clusters.mass(slot);
            view.q[body] = 0.5 * double(clusters.softening_squared[slot]) +
                           gravity.size_softening * clusters.variance[slot];
        }
    });
}

/// Sums of a node's parts, about a point nearby.
struct NodeSums {
    Vector3d origin;
    double mass = 0;
    Vector3d by_mass{0, 0, 0}, by_number{0, 0, 0};
    double number = 0;

    void add(double part_mass, double part_number, const Vector3d& position)
    {
        mass += part_mass;
        number += part_number;
        by_mass += part_mass * (position - origin);
        by_number += part_number * (position - origin);
    }
    void finish(ForceView::Node& node) const
    {
        node.mass = mass;
        node.centre = origin + (mass > 0 ? Vector3d(by_mass / mass) : Vector3d(by_number / number));
    }
};

void sum_up_leaf(const ForceView& view, ForceView::Node& node)
{
    NodeSums sums{.origin = view.position(node.first)};
    for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
        sums.add(view.mass[body], 1, view.position(body));
    sums.finish(node);
    double squared = 0;
    for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
        squared = std::max(squared, (view.position(body) - node.centre).squaredNorm());
    node.radius = std::sqrt(squared);
}

/// From the children, which come later in the array and are summed up already.
void sum_up_inner(ForceView& view, std::size_t index)
{
    ForceView::Node& node = view.nodes[index];
    NodeSums sums{.origin = view.nodes[index + 1].centre};
    for (std::size_t child = index + 1; child < node.next; child = view.nodes[child].next)
        sums.add(view.nodes[child].mass, view.nodes[child].count, view.nodes[child].centre);
    sums.finish(node);
    for (std::size_t child = index + 1; child < node.next; child = view.nodes[child].next)
        node.radius =
            std::max(node.radius, view.nodes[child].radius + (view.nodes[child].centre - node.centre).norm());
}

} // namespace

void measure_shapes(ClusterStore& store, const GravitySettings& gravity, double gravitational_constant,
                    std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            if (clusters.count[slot] < 2) {
                clusters.variance[slot] = 0;
                if (clusters.columns.map)
                    clusters.closure[slot] = 0;
                continue;
            }
            const double mass = clusters.mass(slot);
            const Moments& moments = mass > 0 ? clusters.moments[slot] : clusters.counting_moments(slot);
            const Symmetric3 extent = map_position_moments(moments, clusters.blocks(slot, store.rule, frame));
            const double variance = std::max(extent.trace() / moments.weight, 0.0);
            clusters.variance[slot] = variance;
            if (!clusters.columns.map || !gravity.closure)
                continue;
            // A homogeneous ball with this variance; n / (n - 1) as the sample's variance is biased.
            const double n = clusters.count[slot];
            const double radius_squared =
                5.0 / 3.0 * variance * n / (n - 1) + double(clusters.softening_squared[slot]);
            clusters.closure[slot] = radius_squared > 0 ? gravitational_constant * mass /
                                                              (radius_squared * std::sqrt(radius_squared))
                                                        : 0;
        }
    });
}

void reserve(ForceView& view, std::size_t bodies, std::size_t pools)
{
    for (auto* column : {&view.x, &view.y, &view.z, &view.mass, &view.q})
        column->reserve(bodies);
    view.slot.reserve(bodies);
    view.cells.reserve(pools);
    // An inner node has two children at least; while one is being built, its path may hold some with one.
    view.nodes.reserve(2 * pools + deepest_path);
}

void build(ForceView& view, const SlodTree& tree, const ClusterTable& clusters,
           const GravitySettings& gravity)
{
    view.nodes.clear();
    view.slot.clear();
    for (const Subtree& subtree : tree.subtrees) {
        sort_cells(view.cells, subtree);
        Builder(view, subtree, clusters).add_cells(0, view.cells.size(), 21);
    }
    fill_bodies(view, clusters, gravity);
    const auto leaf = [&](std::size_t node) { return view.nodes[node].next == node + 1; };
    for_each_block(view.nodes.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t node = first; node < last; ++node)
            if (leaf(node))
                sum_up_leaf(view, view.nodes[node]);
    });
    for (std::size_t node = view.nodes.size(); node-- > 0;)
        if (!leaf(node))
            sum_up_inner(view, node);
}

} // namespace slod
