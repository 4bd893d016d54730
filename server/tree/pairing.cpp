#include "tree/pairing.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::uint64_t merge_period = 16; ///< every pool looks for merges once in so many frames

} // namespace

void Pairing::reserve(std::size_t clusters)
{
    partner_.reserve(clusters);
    balls_.reserve(clusters);
    looked_at_.reserve(clusters);
}

std::uint64_t Pairing::find(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                            std::span<const Vector3d> surroundings, std::vector<ClusterSlot>& pairs)
{
    const ClusterTable& clusters = store.clusters;
    partner_.resize(clusters.slot_count());
    balls_.resize(clusters.slot_count());
    pairs.clear();
    std::uint64_t looked_at = 0;
    for (const Subtree& subtree : tree.subtrees) {
        if (subtree.growth_limit() < 2)
            continue;
        const Search search{subtree, store, frame, surroundings[subtree.region],
                            MergeRules(subtree.settings)};
        const std::size_t turn = frame % merge_period;
        const std::size_t turns = (subtree.pools.size() + merge_period - 1 - turn) / merge_period;
        looked_at_.assign(turns, 0);
        for_each_block(turns, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                looked_at_[i] = pair_up(search, subtree.pools[i * merge_period + turn]);
        });
        looked_at = std::accumulate(looked_at_.begin(), looked_at_.end(), looked_at);
        for (std::size_t i = 0; i < turns; ++i)
            for (ClusterSlot a = subtree.pools[i * merge_period + turn].first; a.valid();
                 a = clusters.next[a.index])
                if (const ClusterSlot b = partner_[a.index]; b.valid() && a < b)
                    pairs.insert(pairs.end(), {a, b});
    }
    return looked_at;
}

/// Leaves those out whom even the smallest in the pool would make too large, and those that move at their
/// first particle's velocity: formed anew, they would lose it.
std::uint64_t Pairing::pair_up(const Search& search, const Pool& pool)
{
    const ClusterTable& clusters = search.store.clusters;
    std::uint32_t smallest = std::numeric_limits<std::uint32_t>::max();
    for (ClusterSlot slot = pool.first; slot.valid(); slot = clusters.next[slot.index])
        smallest = std::min(smallest, clusters.count[slot.index]);
    for (ClusterSlot slot = pool.first; slot.valid(); slot = clusters.next[slot.index]) {
        const bool may = clusters.count[slot.index] + smallest <= search.tree.growth_limit() &&
                         !clusters.holds_velocity(slot.index);
        partner_[slot.index] = may ? ClusterSlot{} : slot;
        if (may)
            balls_[slot.index] = velocity_ball(search.store, slot.index, search.frame, search.reference);
    }
    std::uint64_t looked_at = 0;
    for (ClusterSlot a = pool.first; a.valid(); a = clusters.next[a.index]) {
        if (partner_[a.index].valid())
            continue;
        if (const ClusterSlot b = nearest_later(search, a, looked_at); b.valid()) {
            partner_[a.index] = b;
            partner_[b.index] = a;
        }
    }
    return looked_at;
}

ClusterSlot Pairing::nearest_later(const Search& search, ClusterSlot cluster, std::uint64_t& looked_at) const
{
    const ClusterTable& clusters = search.store.clusters;
    const std::size_t a = cluster.index;
    const std::uint32_t most = search.tree.growth_limit() - clusters.count[a];
    ClusterSlot nearest;
    double nearest_squared = std::numeric_limits<double>::infinity();
    std::uint32_t candidates = 0;
    for (ClusterSlot b = clusters.next[a]; b.valid() && candidates < most_candidates;
         b = clusters.next[b.index], ++candidates) {
        if (partner_[b.index].valid() || clusters.count[b.index] > most)
            continue;
        const double squared = (clusters.position[b.index] - clusters.position[a]).squaredNorm();
        if (squared >= nearest_squared || !search.rules.move_alike(balls_[a], balls_[b.index]) ||
            !search.rules.fit(search.store, cluster, b, search.frame))
            continue;
        nearest = b;
        nearest_squared = squared;
    }
    looked_at += candidates;
    return nearest;
}

} // namespace slod
