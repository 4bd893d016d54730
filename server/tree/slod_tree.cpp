#include "tree/slod_tree.hpp"

#include <string>

#include "core/assert.hpp"

namespace slod {

std::uint16_t SlodTree::region_at(const Vector3d&) const
{
    SLOD_ASSERT(!subtrees.empty());
    return std::uint16_t(subtrees.size() - 1);
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

PoolRef locate(const SlodTree& tree, const Vector3d& x)
{
    const std::uint16_t region = tree.region_at(x);
    return {region, locate(tree.subtrees[region], x)};
}

PoolRef locate_or_grow(SlodTree& tree, const Vector3d& x)
{
    const std::uint16_t region = tree.region_at(x);
    return {region, locate_or_grow(tree.subtrees[region], x)};
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
