#include "gravity/force_view.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "core/morton.hpp"
#include "core/parallel.hpp"
#include "gravity/node_sums.hpp"
#include "gravity/pool_nodes.hpp"
#include "gravity/second_moments.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 512;

/// Cells beyond 2^20 from the origin share the codes at the rim: their order suffers, nothing else.
std::uint64_t morton_code(const Cell& cell)
{
    const auto shifted = [](std::int32_t coordinate) {
        return spread_bits(std::uint64_t(std::clamp(coordinate, -(1 << 20), (1 << 20) - 1) + (1 << 20)));
    };
    return shifted(cell.x) | shifted(cell.y) << 1 | shifted(cell.z) << 2;
}

/// Whether there is no cluster below the node: found out at the first one, so mostly in a few steps.
bool holds_nothing(const Subtree& tree, NodeId id)
{
    const Node& node = tree.nodes[id.index];
    if (node.leaf())
        return tree.pools[node.pool.index].clusters == 0;
    return holds_nothing(tree, node.left) && holds_nothing(tree, node.right());
}

/// Those that hold anything.
void sort_cells(std::vector<ForceView::CellRoot>& cells, const Subtree& tree)
{
    cells.clear();
    tree.cells.for_each([&](const Cell& cell, NodeId root) {
        if (!holds_nothing(tree, root))
            cells.push_back({morton_code(cell), cell, root});
    });
    std::sort(cells.begin(), cells.end(), [](const ForceView::CellRoot& a, const ForceView::CellRoot& b) {
        return std::tie(a.key, a.cell) < std::tie(b.key, b.cell);
    });
}

/// Lays out a region's nodes depth first: those above its pools, and room for each pool's bodies and nodes.
/// No node holds nothing, or the same as its only child.
class Layout {
public:
    Layout(ForceView& view, const Subtree& tree, RegionRow region) : view_(view), tree_(tree), region_(region)
    {}

    /// Cells [begin, end), in the order of their codes.
    void add_cells(std::size_t begin, std::size_t end)
    {
        if (begin == end)
            return;
        if (begin + 1 == end) {
            add_tree(view_.cells[begin].root);
            return;
        }
        const std::size_t node = open();
        const std::uint64_t apart = view_.cells[begin].key ^ view_.cells[end - 1].key;
        if (apart == 0) { // bins of one cell, or cells at the rim
            const std::size_t middle = begin + (end - begin) / 2;
            add_cells(begin, middle);
            add_cells(middle, end);
        } else {
            const int shift =
                (int(std::bit_width(apart)) - 1) / 3 * 3; // of the octants in which the cells differ
            for (std::uint64_t octant = 0; octant < 8; ++octant) {
                const auto within = [&](const ForceView::CellRoot& cell) {
                    return (cell.key >> shift & 7) <= octant;
                };
                const auto first = view_.cells.begin();
                const auto split =
                    std::partition_point(first + std::ptrdiff_t(begin), first + std::ptrdiff_t(end), within);
                add_cells(begin, std::size_t(split - first));
                begin = std::size_t(split - first);
            }
        }
        close(node);
    }

private:
    std::size_t open()
    {
        view_.nodes.push_back({.first = bodies()});
        return view_.nodes.size() - 1;
    }

    void close(std::size_t node)
    {
        view_.nodes[node].count = bodies() - view_.nodes[node].first;
        view_.nodes[node].next = std::uint32_t(view_.nodes.size());
    }

    /// The node, or the one of its sides that holds anything.
    void add_tree(NodeId id)
    {
        const Node& node = tree_.nodes[id.index];
        if (node.leaf()) {
            add_pool(node.pool);
        } else if (holds_nothing(tree_, node.left)) {
            add_tree(node.right());
        } else if (holds_nothing(tree_, node.right())) {
            add_tree(node.left);
        } else {
            const std::size_t opened = open();
            add_tree(node.left);
            add_tree(node.right());
            close(opened);
        }
    }

    void add_pool(PoolId id)
    {
        const std::uint32_t clusters = tree_.pools[id.index].clusters;
        const auto first_node = std::uint32_t(view_.nodes.size());
        view_.pools.push_back({region_, id, bodies(), first_node});
        view_.nodes.resize(first_node + nodes_of_pool(clusters));
        view_.nodes[first_node].first = bodies();
        view_.nodes[first_node].count = clusters;
        view_.nodes[first_node].next = std::uint32_t(view_.nodes.size());
        view_.slot.resize(view_.slot.size() + clusters);
    }

    std::uint32_t bodies() const { return std::uint32_t(view_.slot.size()); }

    ForceView& view_;
    const Subtree& tree_;
    RegionRow region_;
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

} // namespace

void reserve(ForceView& view, std::size_t bodies, std::size_t pools, std::size_t regions,
             const GravitySettings& gravity)
{
    for (auto* column : {&view.x, &view.y, &view.z, &view.mass, &view.q})
        column->reserve(bodies);
    view.slot.reserve(bodies);
    view.cells.reserve(pools);
    view.pools.reserve(pools);
    view.regions.reserve(regions);
    view.nodes.reserve(2 * pools + most_pool_nodes(bodies)); // an inner node has two children at least
    if (gravity.multipoles == Multipoles::Quadrupole)
        view.second_moments.reserve(view.nodes.capacity());
}

void build(ForceView& view, const SlodTree& tree, const ClusterTable& clusters,
           const GravitySettings& gravity)
{
    view.nodes.clear();
    view.second_moments.clear();
    view.slot.clear();
    view.pools.clear();
    view.regions.clear();
    for (const Subtree& subtree : tree.subtrees) {
        ForceView::Region region{.first_body = std::uint32_t(view.slot.size()),
                                 .first_node = std::uint32_t(view.nodes.size()),
                                 .attracts = subtree.settings.attracts};
        sort_cells(view.cells, subtree);
        Layout(view, subtree, subtree.region).add_cells(0, view.cells.size());
        region.last_body = std::uint32_t(view.slot.size());
        region.last_node = std::uint32_t(view.nodes.size());
        if (region.body_count() > 0)
            view.regions.push_back(region);
    }
    fill_pools(view, tree, clusters);
    fill_bodies(view, clusters, gravity);
    sum_up_nodes(view);
    if (gravity.multipoles == Multipoles::Quadrupole)
        sum_up_second_moments(view);
}

} // namespace slod
