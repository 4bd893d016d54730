#include <string>

#include "tree/subtree.hpp"

namespace slod {
namespace {

std::string name(const char* kind, std::uint32_t index)
{
    return std::string(kind) + " " + std::to_string(index);
}

void check_node(const Subtree& tree, NodeId id, Problems& found)
{
    const Node& node = tree.nodes[id.index];
    if (node.leaf()) {
        if (!node.pool.valid() || tree.pools[node.pool.index].node != id)
            found.push_back(name("node", id.index) + " is a leaf whose pool does not name it");
        return;
    }
    if (node.pool.valid())
        found.push_back(name("node", id.index) + " has children and a pool");
    const Node& left = tree.nodes[node.left.index];
    const Node& right = tree.nodes[node.right().index];
    Box whole = left.box;
    whole.upper[node.axis] = right.box.upper[node.axis];
    const bool divided = whole.lower == node.box.lower && whole.upper == node.box.upper &&
                         left.box.upper[node.axis] == node.split && right.box.lower[node.axis] == node.split;
    if (!divided || left.parent != id || right.parent != id)
        found.push_back(name("node", id.index) + " is not divided by its children");
    check_node(tree, node.left, found);
    check_node(tree, node.right(), found);
}

void check_pool(const Subtree& tree, const ClusterTable& clusters, PoolId id, Problems& found)
{
    const Pool& pool = tree.pools[id.index];
    std::uint32_t listed = 0;
    std::uint64_t members = 0;
    for (ClusterSlot slot = pool.first; slot.valid() && listed <= pool.clusters;
         slot = clusters.next[slot.index]) {
        ++listed;
        members += clusters.count[slot.index];
        if (!clusters.alive(slot.index))
            found.push_back(name("pool", id.index) + " lists " + name("dead cluster", slot.index));
        if (clusters.pool[slot.index] != id || clusters.region[slot.index] != tree.region)
            found.push_back(name("cluster", slot.index) + " does not name its " + name("pool", id.index));
    }
    if (listed != pool.clusters || members != pool.members)
        found.push_back(name("pool", id.index) + " counts " + std::to_string(pool.clusters) +
                        " clusters and " + std::to_string(pool.members) + " members but lists " +
                        std::to_string(listed) + " and " + std::to_string(members));
}

} // namespace

Problems problems(const Subtree& tree, const ClusterTable& clusters)
{
    Problems found;
    tree.cells.for_each([&](const Cell& cell, NodeId root) {
        const Box& box = tree.nodes[root.index].box;
        Cell there = cell_of(tree, Vector3d(0.5 * (box.lower + box.upper)));
        there.bin = tree.nodes[root.index].bin;
        if (there != cell)
            found.push_back(name("root", root.index) + " is not in its cell");
        check_node(tree, root, found);
    });
    for (std::uint32_t pool = 0; pool < tree.pools.size(); ++pool)
        if (tree.pools[pool].node.valid())
            check_pool(tree, clusters, {pool}, found);
    return found;
}

} // namespace slod
