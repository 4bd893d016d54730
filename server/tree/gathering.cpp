#include "tree/gathering.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/parallel.hpp"
#include "tree/grouping.hpp"

namespace slod {

void Gathering::reserve(std::size_t count)
{
    groups.reserve(count);
    clusters.reserve(count);
    places_.reserve(count);
    next_.reserve(count);
    parts_.reserve(count);
    balls_.reserve(count);
    found_.reserve(count);
}

std::uint64_t Gathering::find(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                              std::span<const Vector3d> surroundings)
{
    const std::size_t slots = store.clusters.slot_count();
    places_.resize(slots);
    next_.resize(slots);
    parts_.resize(slots);
    balls_.resize(slots);
    groups.clear();
    clusters.clear();
    std::uint64_t looked_at = 0;
    for (const Subtree& subtree : tree.subtrees) {
        if (subtree.growth_limit() < 2)
            continue;
        const Search search{subtree, store, frame, surroundings[subtree.region], MergeRules(subtree.settings),
                            0};
        const std::size_t turn = frame % period;
        const std::size_t turns = (subtree.pools.size() + period - 1 - turn) / period;
        found_.assign(turns, {});
        for_each_block(turns, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                found_[i] = search_pool(search, subtree.pools[i * period + turn]);
        });
        for (std::size_t i = 0; i < turns; ++i) {
            looked_at += found_[i].looked_at;
            if (found_[i].groups)
                list_groups(store.clusters, subtree.pools[i * period + turn]);
        }
    }
    return looked_at;
}

/// Whether the pool's smallest clusters are small enough: for no number of parts there may be one more.
bool Gathering::may_gather(const Search& search, const Pool& pool)
{
    const ClusterTable& table = search.store.clusters;
    std::array<std::uint64_t, most_parts + 1> least; // in order
    least.fill(std::numeric_limits<std::uint32_t>::max());
    for (ClusterSlot slot = pool.first; slot.valid(); slot = table.next[slot.index]) {
        std::uint64_t count = table.count[slot.index];
        for (std::uint64_t& each : least)
            if (count < each)
                std::swap(count, each);
    }
    std::uint64_t members = least[0];
    for (std::uint32_t parts = 1; parts <= most_parts; ++parts)
        if ((members += least[parts]) <= std::uint64_t(parts) * search.tree.growth_limit())
            return true;
    return false;
}

/// Leaves out those that move at their first particle's velocity: formed anew, they would lose it.
Gathering::Found Gathering::search_pool(Search search, const Pool& pool)
{
    if (pool.clusters < 2 || !may_gather(search, pool))
        return {};
    const ClusterTable& table = search.store.clusters;
    search.smallest = std::numeric_limits<std::uint32_t>::max();
    for (ClusterSlot slot = pool.first; slot.valid(); slot = table.next[slot.index]) {
        const bool out = table.holds_velocity(slot.index);
        places_[slot.index] = out ? Place::Out : Place::Free;
        if (out)
            continue;
        search.smallest = std::min(search.smallest, table.count[slot.index]);
        balls_[slot.index] = velocity_ball(search.store, slot.index, search.frame, search.reference);
    }
    Found found;
    for (ClusterSlot seed = pool.first; seed.valid(); seed = table.next[seed.index])
        for (std::uint32_t parts = 1; parts <= most_parts && places_[seed.index] == Place::Free; ++parts)
            if (gather(search, seed, parts, found.looked_at))
                found.groups = true;
    return found;
}

/// Makes the cluster the seed of those that it gathers, if that is one more than `parts` at least; returns
/// whether it is.
bool Gathering::gather(const Search& search, ClusterSlot seed, std::uint32_t parts, std::uint64_t& looked_at)
{
    const ClusterTable& table = search.store.clusters;
    if (table.count[seed.index] + std::uint64_t(parts) * search.smallest >
        std::uint64_t(parts) * search.tree.growth_limit())
        return false;
    Heap heap{parts, 1, table.count[seed.index], balls_[seed.index], crowd(search, seed)};
    next_[seed.index] = {};
    places_[seed.index] = Place::Seed;
    for (ClusterSlot last = seed;; last = next_[last.index]) {
        const ClusterSlot nearest = nearest_later(search, seed, heap, looked_at);
        next_[last.index] = nearest;
        if (!nearest.valid())
            break;
        next_[nearest.index] = {};
        places_[nearest.index] = Place::Follower;
        ++heap.clusters;
        heap.members += table.count[nearest.index];
        heap.ball = enclosing_ball(heap.ball, balls_[nearest.index]);
        heap.crowd = heap.crowd + crowd(search, nearest);
    }
    parts_[seed.index] = clusters_for(heap.members, search.tree.growth_limit());
    if (heap.clusters > parts_[seed.index])
        return true;
    for (ClusterSlot slot = seed; slot.valid(); slot = next_[slot.index])
        places_[slot.index] = Place::Free;
    return false;
}

/// The nearest one after the seed that the heap may take, and still become fewer clusters than it has then.
ClusterSlot Gathering::nearest_later(const Search& search, ClusterSlot seed, const Heap& heap,
                                     std::uint64_t& looked_at) const
{
    const ClusterTable& table = search.store.clusters;
    const std::uint64_t to_come = heap.clusters < heap.parts ? heap.parts - heap.clusters : 0;
    const std::uint64_t taken = heap.members + to_come * search.smallest;
    const std::uint64_t room = std::uint64_t(heap.parts) * search.tree.growth_limit();
    if (taken >= room)
        return {};
    ClusterSlot nearest;
    double nearest_squared = std::numeric_limits<double>::infinity();
    std::uint32_t candidates = 0;
    for (ClusterSlot b = table.next[seed.index]; b.valid() && candidates < most_candidates;
         b = table.next[b.index], ++candidates) {
        if (places_[b.index] != Place::Free || table.count[b.index] > room - taken)
            continue;
        const double squared = (table.position[b.index] - heap.crowd.centre).squaredNorm();
        if (squared >= nearest_squared || !search.rules.move_alike(heap.ball, balls_[b.index]))
            continue;
        if (search.rules.limit_breadth() && !search.rules.fit(heap.crowd + crowd(search, b), heap.parts))
            continue;
        nearest = b;
        nearest_squared = squared;
    }
    looked_at += candidates;
    return nearest;
}

/// What is there of a cluster, as far as the rules ask: without a limit of breadth just where it is.
Crowd Gathering::crowd(const Search& search, ClusterSlot slot)
{
    const ClusterTable& table = search.store.clusters;
    if (search.rules.limit_breadth())
        return crowd_of(search.store, slot.index, search.frame);
    return {double(table.count[slot.index]), table.position[slot.index], Matrix3d::Zero()};
}

void Gathering::list_groups(const ClusterTable& table, const Pool& pool)
{
    for (ClusterSlot seed = pool.first; seed.valid(); seed = table.next[seed.index]) {
        if (places_[seed.index] != Place::Seed)
            continue;
        Group group{.first = std::uint32_t(clusters.size()), .parts = parts_[seed.index]};
        for (ClusterSlot slot = seed; slot.valid(); slot = next_[slot.index]) {
            clusters.push_back(slot);
            group.members += table.count[slot.index];
            ++group.clusters;
        }
        groups.push_back(group);
    }
}

} // namespace slod
