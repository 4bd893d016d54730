#include "tree/crowded.hpp"

#include <algorithm>
#include <numeric>

namespace slod {
namespace {

bool before(const SplitKey& a, const SplitKey& b)
{
    return a.coordinate != b.coordinate ? a.coordinate < b.coordinate : a.slot < b.slot;
}

/// The clusters of a crowded pool on their way to the leaves it is split into. They are in no pool meanwhile:
/// each level re-orders one list of them, and only the leaves are given lists of their own.
class Splitting {
public:
    Splitting(Subtree& tree, ClusterTable& clusters, double limit, const SplitScratch& scratch)
        : tree_(tree), clusters_(clusters), limit_(limit), scratch_(scratch)
    {}

    std::uint64_t run(PoolId pool)
    {
        std::size_t count = 0;
        for (ClusterSlot slot = tree_.pools[pool.index].first; slot.valid();
             slot = clusters_.next[slot.index])
            scratch_.slots[count++] = slot;
        divide(pool, 0, count, tree_.pools[pool.index].members);
        return looked_at_;
    }

private:
    /// Splits the pool, which is to hold the slots from `first` on, as far as its members ask for. The tree's
    /// depth is bounded, and so is the recursion.
    void divide(PoolId pool, std::size_t first, std::size_t count, std::uint64_t members)
    {
        clear(pool);
        while (double(members) > limit_ && count > 1 && can_expand(tree_, pool)) {
            const Box box = tree_.nodes[tree_.pools[pool.index].node.index].box;
            const int axis = box.longest_side();
            const double position = split_position(box, axis, median(first, count, members, axis));
            const Lower lower = part(first, count, position, axis);
            const PoolId right = expand(tree_, clusters_, pool, axis, position);
            divide(right, first + lower.count, count - lower.count, members - lower.members);
            count = lower.count;
            members = lower.members;
        }
        for (std::size_t i = first + count; i-- > first;) // each is put in front of the list
            link(tree_, clusters_, pool, scratch_.slots[i]);
    }

    void clear(PoolId pool)
    {
        tree_.pools[pool.index].first = {};
        tree_.pools[pool.index].clusters = tree_.pools[pool.index].members = 0;
    }

    double coordinate(ClusterSlot slot, int axis) const { return clusters_.position[slot.index][axis]; }

    /// The coordinate of the first cluster with half of the members before it, or else of the last one: found
    /// by bisection, which halves what is left to look at each time.
    double median(std::size_t first, std::size_t count, std::uint64_t members, int axis)
    {
        const auto keys = scratch_.keys.first(count);
        for (std::size_t i = 0; i < count; ++i) {
            const ClusterSlot slot = scratch_.slots[first + i];
            keys[i] = {coordinate(slot, axis), slot, clusters_.count[slot.index]};
        }
        const auto add = [](std::uint64_t sum, const SplitKey& key) { return sum + key.members; };
        auto least = keys.begin(), most = keys.end() - 1;
        std::uint64_t below = 0;
        while (least != most) {
            looked_at_ += std::uint64_t(most - least) + 1;
            const auto middle = least + (most - least) / 2;
            std::nth_element(least, middle, most + 1, before);
            const std::uint64_t there = std::accumulate(least, middle, below, add);
            if (2 * there >= members) {
                most = middle;
            } else {
                below = there + middle->members;
                least = middle + 1;
            }
        }
        return least->coordinate;
    }

    struct Lower {
        std::size_t count = 0;
        std::uint64_t members = 0;
    };

    /// Puts the clusters below `position` in front, in the same order, and the others behind them in reverse:
    /// as if each of these were taken off one list and put in front of another.
    Lower part(std::size_t first, std::size_t count, double position, int axis)
    {
        const auto slots = scratch_.slots.subspan(first, count);
        Lower lower;
        std::size_t upper = 0;
        for (const ClusterSlot slot : slots) {
            if (coordinate(slot, axis) >= position) {
                scratch_.spare[upper++] = slot;
            } else {
                lower.members += clusters_.count[slot.index];
                slots[lower.count++] = slot;
            }
        }
        std::reverse_copy(scratch_.spare.begin(), scratch_.spare.begin() + std::ptrdiff_t(upper),
                          slots.begin() + std::ptrdiff_t(lower.count));
        return lower;
    }

    Subtree& tree_;
    ClusterTable& clusters_;
    double limit_;
    SplitScratch scratch_;
    std::uint64_t looked_at_ = 0;
};

} // namespace

void SplitMemory::reserve(std::size_t clusters)
{
    slots_.reserve(clusters);
    spare_.reserve(clusters);
    keys_.reserve(clusters);
}

void SplitMemory::resize(std::size_t clusters)
{
    slots_.resize(clusters);
    spare_.resize(clusters);
    keys_.resize(clusters);
}

SplitScratch SplitMemory::slice(std::size_t first, std::size_t count)
{
    return {std::span(slots_).subspan(first, count), std::span(spare_).subspan(first, count),
            std::span(keys_).subspan(first, count)};
}

std::uint64_t expand_crowded(Subtree& tree, ClusterTable& clusters, PoolId pool, double limit,
                             const SplitScratch& scratch)
{
    const Pool& crowd = tree.pools[pool.index];
    if (crowd.members <= limit || crowd.clusters <= 1 || !can_expand(tree, pool))
        return 0;
    return Splitting(tree, clusters, limit, scratch).run(pool);
}

} // namespace slod
