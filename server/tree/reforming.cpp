#include "tree/reforming.hpp"

#include <algorithm>
#include <bit>

#include "core/assert.hpp"
#include "core/make_room.hpp"
#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr double sparse = 0.5; ///< of the pool limit: two sibling leaves are merged
/// Pools that keep one turn. Neighbours that end their lives together exchange members without strays;
/// all pools at once would make every other frame long.
constexpr std::uint32_t pools_per_turn = 16;
/// Share of the maximum size that clusters are formed at where strays come, to fill the rest.
constexpr double filled = 0.7;

/// A particle where it will be, accelerated as the cluster it comes from.
Subject subject_of(const Grouping& grouping, std::uint32_t index)
{
    const Particle& particle = grouping.particles[index];
    return {grouping.place[index], double(particle.mass), particle.velocity.norm(),
            double(grouping.pull[index])};
}

/// Frames that a life counts shorter where its middle is asked for. Its forces kick at its beginning and at
/// the ends of all its frames but the last, so 1 would treat past and future alike, and the drift of the
/// energy would go to 0 with short lives whatever the softening and the closure. Forces of clusters are noise
/// besides, which heats in proportion to the life; less than 1 is a friction. A third balances both at 4 to
/// 16 particles a cluster.
constexpr double early = 1.0 / 3;

} // namespace

Reforming::Reforming(const MotionSettings& motion, const UpdateContext& context)
    : motion_(motion), context_(context)
{}

void Reforming::found(SlodTree& tree, std::span<const Particle> particles, std::uint64_t frame, Strays strays)
{
    context_.frame = frame;
    due_.clear();
    grouping_.clear();
    grouping_.particles.assign(particles.begin(), particles.end());
    grouping_.resize(particles.size());
    target_.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        grouping_.place[i] = particles[i].position;
        target_[i] = locate_or_grow(tree, subject_of(grouping_, std::uint32_t(i)));
        start_life(tree.pool(target_[i]), motion_.shortest_life);
    }
    gather_groups(tree);
    expand_crowded(tree);
    form(tree, strays);
}

void Reforming::reform_all(SlodTree& tree, std::uint64_t frame, UpdateCounts& counts)
{
    for (Subtree& subtree : tree.subtrees)
        for (Pool& pool : subtree.pools)
            pool.due_frame = frame;
    update(tree, frame, counts);
}

void Reforming::reserve(const SlodTree& tree, std::size_t particle_count)
{
    const std::size_t pools = tree.pool_capacity();
    const std::size_t clusters = context_.store.clusters.slot_capacity();
    grouping_.reserve(particle_count, pools, clusters);
    make_room(target_, particle_count);
    due_.reserve(pools);
    arrivals_.reserve(pools);
    pool_base_.reserve(tree.subtrees.size());
    ending_.reserve(clusters);
}

void Reforming::update(SlodTree& tree, std::uint64_t frame, UpdateCounts& counts)
{
    context_.frame = frame;
    counts.worn_pools += end_worn_lives(tree);
    merge_sparse_pools(tree);
    start_lives(tree);
    if (!due_.empty())
        reform(tree, counts);
    free_closed(tree);
}

void Reforming::reform(SlodTree& tree, UpdateCounts& counts)
{
    map_out_due(tree);
    find_targets(tree);
    gather_groups(tree);
    expand_crowded(tree);
    place_strays(tree, counts);
    form(tree, Strays::Come);
    counts.due_pools += due_.size();
    counts.reformed_members += grouping_.particles.size();
}

/// Makes pools due that hold a worn map; returns how many. Tides that grow fast within a life make them.
std::uint64_t Reforming::end_worn_lives(SlodTree& tree)
{
    const ClusterTable& clusters = context_.store.clusters;
    if (!clusters.columns.map)
        return 0;
    const auto is_worn_out = [&](std::size_t slot) {
        return clusters.alive(slot) && is_worn(clusters.map[slot]);
    };
    const bool none = holds_in_blocks(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
        bool sound = true;
        for (std::size_t slot = first; slot < last; ++slot)
            sound = sound && !is_worn_out(slot);
        return sound;
    });
    if (none)
        return 0;
    std::uint64_t ended = 0;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!is_worn_out(slot))
            continue;
        Pool& pool = tree.pool({clusters.region[slot], clusters.pool[slot]});
        ended += pool.due_frame > context_.frame ? 1 : 0;
        pool.due_frame = std::min(pool.due_frame, context_.frame);
    }
    return ended;
}

/// A due pool that has become sparse is merged with its sibling, which is made due with it.
void Reforming::merge_sparse_pools(SlodTree& tree)
{
    for (Subtree& subtree : tree.subtrees) {
        const auto limit = std::uint32_t(sparse * subtree.pool_limit());
        for (std::uint32_t index = 0; index < subtree.pools.size(); ++index) {
            const Pool& pool = subtree.pools[index];
            if (pool.node.valid() && pool.due_frame <= context_.frame && pool.members < limit)
                prune(subtree, context_.store.clusters, {index}, limit);
        }
    }
}

void Reforming::start_lives(SlodTree& tree)
{
    due_.clear();
    std::uint32_t first = 0;
    for (Subtree& subtree : tree.subtrees) {
        for (std::uint32_t index = 0; index < subtree.pools.size(); ++index) {
            Pool& pool = subtree.pools[index];
            if (!pool.node.valid() || pool.due_frame > context_.frame)
                continue;
            const PoolRef ref{subtree.region, {index}};
            due_.push_back({ref, first, pool.members});
            first += pool.members;
        }
    }
    for_each_block(due_.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            start_life(tree.pool(due_[i].pool), wanted_life(tree, due_[i].pool));
    });
}

/// The dynamical clock: a power of two of frames near clock / (step sqrt(|T|)), |T| the mean over members.
std::uint64_t Reforming::wanted_life(const SlodTree& tree, const PoolRef& ref) const
{
    const Pool& pool = tree.pool(ref);
    const bool first_turn = pool.turn_frame == Pool::no_turn;
    if (pool.members == 0)
        return first_turn ? motion_.shortest_life
                          : std::max<std::uint64_t>(pool.life(), motion_.shortest_life);
    const ClusterTable& clusters = context_.store.clusters;
    double tide = 0;
    for (ClusterSlot slot = pool.first; slot.valid(); slot = clusters.next[slot.index])
        tide += clusters.count[slot.index] * clusters.rate_squared(slot.index);
    if (first_turn && tide == 0) // of newborns none is known yet; pools that were laid anew hold others
        return motion_.shortest_life;
    tide /= pool.members;
    const double ratio = motion_.clock / context_.step;
    std::uint64_t life = motion_.shortest_life;
    while (life < motion_.longest_life && ratio * ratio >= 2.0 * double(life * life) * tide)
        life *= 2;
    return life;
}

/// Lives end at multiples of their length, shifted by the pool's phase, so that neighbours that live
/// equally long keep their rhythm; the first one after a change is shorter or longer than asked.
void Reforming::start_life(Pool& pool, std::uint64_t life) const
{
    std::uint64_t remaining = life - (context_.frame + pool.phase) % life;
    if (remaining < motion_.shortest_life)
        remaining += life;
    pool.turn_frame = context_.frame;
    pool.due_frame = context_.frame + remaining;
}

void Reforming::map_out_due(SlodTree& tree)
{
    const ClusterTable& clusters = context_.store.clusters;
    ending_.clear();
    for (const Due& due : due_)
        for (ClusterSlot slot = tree.pool(due.pool).first; slot.valid(); slot = clusters.next[slot.index])
            ending_.push_back(slot);
    grouping_.clear();
    dissolve(tree, grouping_, ending_, context_);
    target_.resize(grouping_.particles.size());
}

/// Each member goes to the pool where it will be in the middle of the life that begins, and is grouped by
/// its place in the middle of that pool's life.
void Reforming::find_targets(SlodTree& tree)
{
    const auto midway = [&](const Particle& particle, std::uint64_t life) -> Vector3d {
        return particle.position + (0.5 * context_.step * (double(life) - early)) * particle.velocity;
    };
    const bool bounded = holds_in_blocks(due_.size(), 4, [&](std::size_t begin, std::size_t end) {
        bool all_finite = true;
        for (std::size_t d = begin; d < end; ++d) {
            const std::uint64_t life = tree.pool(due_[d].pool).life();
            for (std::uint32_t i = due_[d].first; i < due_[d].first + due_[d].count; ++i) {
                const Particle& particle = grouping_.particles[i];
                grouping_.place[i] = midway(particle, life);
                all_finite = all_finite && grouping_.place[i].allFinite();
                target_[i] = locate(tree, subject_of(grouping_, i));
                if (!target_[i].valid())
                    continue;
                const std::uint64_t there = tree.pool(target_[i]).due_frame - context_.frame;
                if (there != life)
                    grouping_.place[i] = midway(particle, there);
            }
        }
        return all_finite;
    });
    if (!bounded)
        refuse_unbounded(context_.frame);
    for (const Due& due : due_) {
        const std::uint64_t life = tree.pool(due.pool).life();
        for (std::uint32_t i = due.first; i < due.first + due.count; ++i) {
            if (target_[i].valid())
                continue;
            target_[i] = locate_or_grow(tree, subject_of(grouping_, i));
            if (Pool& pool = tree.pool(target_[i]); !due_now(pool))
                start_life(pool, std::bit_floor(std::max<std::uint64_t>(life, motion_.shortest_life)));
        }
    }
}

/// A stable counting sort of the particles by target.
void Reforming::gather_groups(const SlodTree& tree)
{
    pool_base_.clear();
    std::uint32_t pools = 0;
    for (const Subtree& subtree : tree.subtrees) {
        pool_base_.push_back(pools);
        pools += std::uint32_t(subtree.pools.size());
    }
    const auto flat = [&](const PoolRef& pool) { return pool_base_[pool.region] + pool.pool.index; };
    arrivals_.assign(pools, 0);
    for (const PoolRef& target : target_)
        ++arrivals_[flat(target)];
    std::uint32_t first = 0;
    for (const Subtree& subtree : tree.subtrees) {
        for (std::uint32_t index = 0; index < subtree.pools.size(); ++index) {
            std::uint32_t& arriving = arrivals_[pool_base_[subtree.region] + index];
            const std::uint32_t count = arriving;
            if (count > 0)
                grouping_.groups.push_back(
                    {.pool = {subtree.region, {index}}, .first = first, .count = count});
            arriving = first;
            first += count;
        }
    }
    for (std::uint32_t i = 0; i < target_.size(); ++i)
        grouping_.order[arrivals_[flat(target_[i])]++] = i;
}

void Reforming::expand_crowded(SlodTree& tree)
{
    for (std::size_t group = 0; group < grouping_.groups.size(); ++group) // grows
        if (due_now(tree.pool(grouping_.groups[group].pool)))
            expand_group(tree, group);
}

/// Splits the group's leaf at the median of the particles until what stays is no longer crowded; what goes
/// to the other side is appended as a group of its own.
void Reforming::expand_group(SlodTree& tree, std::size_t index)
{
    const Subtree& subtree = tree.of(grouping_.groups[index].pool);
    const std::uint32_t limit = subtree.pool_limit();
    for (;;) {
        Grouping::Group& group = grouping_.groups[index];
        if (group.count <= limit || !can_expand(subtree, group.pool.pool))
            return;
        const Box& box = subtree.nodes[tree.pool(group.pool).node.index].box;
        const int axis = box.longest_side();
        const auto begin = grouping_.order.begin() + group.first;
        const auto end = begin + group.count;
        const auto middle = begin + group.count / 2;
        const auto coordinate = [&](std::uint32_t particle) { return grouping_.place[particle][axis]; };
        std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
            return coordinate(a) != coordinate(b) ? coordinate(a) < coordinate(b) : a < b;
        });
        const double position = split_position(box, axis, coordinate(*middle));
        const auto cut =
            std::partition(begin, end, [&](std::uint32_t i) { return coordinate(i) < position; });
        const auto lower = std::uint32_t(cut - begin);
        const PoolId right =
            expand(tree.of(group.pool), context_.store.clusters, group.pool.pool, axis, position);
        if (group.count > pools_per_turn * limit)
            take_own_turn(tree.of(group.pool), right);
        const Grouping::Group other{
            .pool = {group.pool.region, right}, .first = group.first + lower, .count = group.count - lower};
        group.count = lower;
        grouping_.groups.push_back(other);
    }
}

void Reforming::place_strays(SlodTree& tree, UpdateCounts& counts)
{
    std::vector<Grouping::Group>& groups = grouping_.groups;
    grouping_.slots.clear();
    arrivals_.assign(groups.size(), 0); // inserted, by group
    for_each_block(groups.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t group = begin; group < end; ++group)
            if (!due_now(tree.pool(groups[group].pool)))
                arrivals_[group] = insert_strays(tree, groups[group]);
    });
    for (std::size_t group = 0; group < groups.size(); ++group) {
        const Pool& pool = tree.pool(groups[group].pool);
        if (due_now(pool))
            continue;
        const std::uint64_t strays = arrivals_[group] + groups[group].count;
        counts.strays_inserted += arrivals_[group];
        counts.strays_founding += groups[group].count;
        counts.stray_tests += strays * std::min(pool.clusters, most_candidates);
    }
}

/// Puts the group's particles into the nearest clusters of its pool, of the first so many, where they are
/// near enough and have room; the others stay in the group. Returns how many found a place.
std::uint32_t Reforming::insert_strays(SlodTree& tree, Grouping::Group& group)
{
    ClusterTable& clusters = context_.store.clusters;
    Pool& pool = tree.pool(group.pool);
    const std::uint32_t most = tree.of(group.pool).max_cluster_size();
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < group.count; ++i) {
        const std::uint32_t index = grouping_.order[group.first + i];
        const Particle& stray = grouping_.particles[index];
        ClusterSlot nearest;
        double nearest_squared = 0;
        std::uint32_t candidates = 0;
        for (ClusterSlot slot = pool.first; slot.valid() && candidates < most_candidates;
             slot = clusters.next[slot.index], ++candidates) {
            const double squared = (stray.position - clusters.position[slot.index]).squaredNorm();
            if (!nearest.valid() || squared < nearest_squared) {
                nearest = slot;
                nearest_squared = squared;
            }
        }
        const bool fits = nearest.valid() && nearest_squared <= 4 * clusters.variance[nearest.index] &&
                          clusters.count[nearest.index] < most &&
                          takes_members(context_.store, nearest, context_.frame);
        if (fits) {
            insert_member(context_.store, nearest, stray, context_.frame);
            ++pool.members;
        } else {
            grouping_.order[group.first + left++] = index;
        }
    }
    const std::uint32_t inserted = group.count - left;
    group.count = left;
    return inserted;
}

void Reforming::form(SlodTree& tree, Strays strays)
{
    const double share = strays == Strays::Come ? filled : 1;
    for (Grouping::Group& group : grouping_.groups) {
        const Subtree& subtree = tree.of(group.pool);
        const std::uint32_t size = subtree.max_cluster_size();
        const double most = subtree.dithered ? subtree.settings.max_cluster_size : size;
        const double goal = std::max(share * most, 1.0);
        group.clusters = clusters_for(group.count, goal);
        group.spare_rows = size - std::uint32_t(goal);
    }
    form_groups(grouping_, context_);
    link_groups(tree, grouping_, context_.store.clusters);
}

} // namespace slod
