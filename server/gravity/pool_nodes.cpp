#include "gravity/pool_nodes.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::uint32_t leaf_bodies = 12; ///< a node with more is halved
constexpr std::size_t pools_of_a_task = 16;

/// Halves one pool's clusters depth first. Pools of small clusters hold hundreds of them, and those of
/// coincident particles, which no plane divides, any number.
class Halving {
public:
    Halving(ForceView& view, const ClusterTable& clusters, std::uint32_t node)
        : view_(view), clusters_(clusters), node_(node)
    {}

    void add(std::uint32_t first, std::uint32_t last)
    {
        ForceView::Node& node = view_.nodes[node_++];
        node.first = first;
        node.count = last - first;
        if (node.count > leaf_bodies) {
            const std::uint32_t middle = first + node.count / 2;
            halve(first, middle, last);
            add(first, middle);
            add(middle, last);
        }
        node.next = node_;
    }

private:
    /// Sorts clusters about the median of their longest side; coincident ones by their slots.
    void halve(std::uint32_t first, std::uint32_t middle, std::uint32_t last)
    {
        Vector3d lower = place(view_.slot[first]), upper = lower;
        for (std::uint32_t body = first + 1; body < last; ++body) {
            lower = lower.cwiseMin(place(view_.slot[body]));
            upper = upper.cwiseMax(place(view_.slot[body]));
        }
        int axis = 0;
        (upper - lower).maxCoeff(&axis);
        const auto run = view_.slot.begin();
        std::nth_element(run + first, run + middle, run + last, [&](ClusterSlot a, ClusterSlot b) {
            return place(a)[axis] != place(b)[axis] ? place(a)[axis] < place(b)[axis] : a < b;
        });
    }

    const Vector3d& place(ClusterSlot slot) const { return clusters_.position[slot.index]; }

    ForceView& view_;
    const ClusterTable& clusters_;
    std::uint32_t node_; ///< the next one's place
};

} // namespace

/// The parts of one level differ by one at most.
std::uint32_t nodes_of_pool(std::uint32_t clusters)
{
    std::uint32_t nodes = 1;
    std::uint32_t smaller = clusters, count_smaller = 1, count_larger = 0; // by one more
    while (smaller + (count_larger > 0 ? 1 : 0) > leaf_bodies) {
        const bool halve_smaller = smaller > leaf_bodies;
        const std::uint32_t halved = count_larger + (halve_smaller ? count_smaller : 0);
        nodes += 2 * halved;
        const std::uint32_t half = smaller / 2;
        if (!halve_smaller) // the larger ones alone, of smaller + 1: none of their halves is halved
            break;
        if (smaller % 2 == 0) { // half, half; half, half + 1
            count_smaller = 2 * count_smaller + count_larger;
        } else { // half, half + 1; half + 1, half + 1
            const std::uint32_t ones = count_smaller;
            count_larger = count_smaller + 2 * count_larger;
            count_smaller = ones;
        }
        smaller = half;
    }
    return nodes;
}

/// A part has half of leaf_bodies at least where it is not a whole pool.
std::size_t most_pool_nodes(std::size_t clusters)
{
    return 4 * clusters / leaf_bodies;
}

void fill_pools(ForceView& view, const SlodTree& tree, const ClusterTable& clusters)
{
    for_each_block(view.pools.size(), pools_of_a_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const ForceView::PoolPlace& place = view.pools[i];
            std::uint32_t body = place.first_body;
            for (ClusterSlot slot = tree.subtrees[place.region].pools[place.pool.index].first; slot.valid();
                 slot = clusters.next[slot.index])
                view.slot[body++] = slot;
            Halving(view, clusters, place.first_node).add(place.first_body, body);
        }
    });
}

} // namespace slod
