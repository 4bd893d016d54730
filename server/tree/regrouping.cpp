#include "tree/regrouping.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "tree/merge_rules.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 1024;          ///< clusters planned by one task
constexpr std::size_t most_blocks = 64;      ///< of clusters whose velocities are summed up, by region
constexpr std::uint64_t revision_period = 8; ///< frames between revisions of a leaf
/// Frames over which a region's clusters are split when its maximum size falls: a sweep, not a stroke.
constexpr std::uint64_t split_period = 8;
/// Of the pool limit; apart, as clusters come and go.
constexpr double crowded = 1.4, sparse = 0.7;

/// Whether all the pool's clusters are in its leaf.
bool holds_all(const Subtree& subtree, const ClusterTable& clusters, std::uint32_t pool)
{
    for (ClusterSlot slot = subtree.pools[pool].first; slot.valid(); slot = clusters.next[slot.index])
        if (!holds(subtree, {pool}, clusters.position[slot.index]))
            return false;
    return true;
}

} // namespace

void Regrouping::reserve(const SlodTree& tree, std::size_t particle_count)
{
    surroundings_.reserve(tree.subtrees.size());
    rushes_.reserve(most_blocks * tree.subtrees.size());
    const std::size_t clusters = context_.store.clusters.slot_capacity();
    grouping_.reserve(particle_count, clusters, clusters);
    actions_.reserve(clusters);
    targets_.reserve(clusters);
    searches_.reserve(clusters / block + 1);
    gathering_.reserve(clusters);
    split_memory_.reserve(clusters);
    revisions_.reserve(tree.subtrees.size());
    turns_.reserve(tree);
    held_.reserve(context_.store.clusters.columns.withheld ? clusters : 0);
    for (auto* list : {&crossing_, &splitting_})
        list->reserve(clusters);
}

void Regrouping::update(SlodTree& tree, std::uint64_t frame, UpdateCounts& counts)
{
    context_.frame = frame;
    // Forces are evaluated over the pools; and rigid clusters move in the tree as the paper has it, just when
    // they cross a face (section 4.3).
    turns_.give(tree, frame, motion_ == Motion::Rigid || context_.store.clusters.columns.acceleration);
    plan(tree, counts);
    move_crossing(tree, counts);
    split(tree, counts);
    revise(tree, counts);
    const auto grow = [](const Subtree& subtree) { return subtree.growth_limit() > 1; };
    if (tree.merging && std::any_of(tree.subtrees.begin(), tree.subtrees.end(), grow))
        merge(tree, counts);
    free_closed(tree);
}

void Regrouping::plan(const SlodTree& tree, UpdateCounts& counts)
{
    const ClusterTable& clusters = context_.store.clusters;
    actions_.resize(clusters.slot_count());
    targets_.resize(clusters.slot_count());
    searches_.assign((clusters.slot_count() + block - 1) / block, {});
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot)
            actions_[slot] =
                clusters.alive(slot) ? action(tree, slot, searches_[first / block]) : Action::Stay;
    });
    for (const Search& search : searches_) {
        counts.nodes_searched += search.nodes;
        counts.boundary_tests += search.tests;
    }
    crossing_.clear();
    splitting_.clear();
    for (std::uint32_t slot = 0; slot < actions_.size(); ++slot) {
        if (actions_[slot] == Action::Cross)
            crossing_.push_back({slot});
        else if (actions_[slot] == Action::Split)
            splitting_.push_back({slot});
    }
}

Regrouping::Action Regrouping::action(const SlodTree& tree, std::size_t slot, Search& search)
{
    const ClusterTable& clusters = context_.store.clusters;
    const Subtree& subtree = tree.subtrees[clusters.region[slot]];
    const std::uint32_t count = clusters.count[slot];
    if ((slot + context_.frame) % split_period == 0 && count > subtree.split_size(clusters.formation[slot]))
        return Action::Split;
    if (too_wide(context_.store, subtree.settings, {std::uint32_t(slot)}, context_.frame))
        return Action::Split;
    return turns_.has(subtree, clusters.pool[slot].index) && crosses(tree, slot, search) ? Action::Cross
                                                                                         : Action::Stay;
}

/// Whether the cluster has left its leaf or belongs to another region; where it goes is in `targets_`. The
/// index is asked where the leaf's mark says that there are other regions, and whenever the cluster has left
/// its leaf, as the mark says nothing of where it is then. Within its region the search is bottom-up.
bool Regrouping::crosses(const SlodTree& tree, std::size_t slot, Search& search)
{
    const ClusterTable& clusters = context_.store.clusters;
    const Subtree& subtree = tree.subtrees[clusters.region[slot]];
    const PoolId pool = clusters.pool[slot];
    const Subject subject =
        turns_.all_at_once() ? subject_of(clusters, slot) : Subject(clusters.position[slot]);
    const bool stays = holds(subtree, pool, subject);
    const bool contested = subtree.nodes[subtree.pools[pool.index].node.index].contested;
    if (stays && !contested)
        return false;
    const RegionRow region = tree.index.find(subject, &search.tests);
    if (stays && region == subtree.region)
        return false;
    targets_[slot] = {region, region == subtree.region
                                  ? locate_near(subtree, pool, subject, &search.nodes)
                                  : locate(tree.subtrees[region], subject, &search.nodes)};
    return true;
}

/// One after the other, as lists are in the order of arrival; their ends are all over the memory, and are
/// asked for in time.
void Regrouping::move_crossing(SlodTree& tree, UpdateCounts& counts)
{
    ClusterTable& clusters = context_.store.clusters;
    constexpr std::size_t ahead = 8;
    for (std::size_t i = 0; i < crossing_.size(); ++i) {
        if (i + ahead < crossing_.size())
            fetch_links(tree, crossing_[i + ahead]);
        const ClusterSlot slot = crossing_[i];
        if (!clusters.position[slot.index].allFinite())
            refuse_unbounded(context_.frame);
        const PoolRef from{clusters.region[slot.index], clusters.pool[slot.index]};
        PoolRef to = targets_[slot.index];
        if (!to.valid())
            to = locate_or_grow(tree, subject_of(clusters, slot.index));
        if (to == from)
            continue; // beyond the rim of the grid
        unlink(tree.of(from), clusters, slot);
        link(tree.of(to), clusters, to.pool, slot);
        ++counts.crossings;
    }
}

/// Has the processor fetch what unlinking the cluster and linking it where it goes will write.
void Regrouping::fetch_links(const SlodTree& tree, ClusterSlot slot) const
{
    const ClusterTable& clusters = context_.store.clusters;
    if (const ClusterSlot next = clusters.next[slot.index]; next.valid())
        __builtin_prefetch(&clusters.previous[next.index], 1);
    if (const ClusterSlot previous = clusters.previous[slot.index]; previous.valid())
        __builtin_prefetch(&clusters.next[previous.index], 1);
    __builtin_prefetch(&tree.pool({clusters.region[slot.index], clusters.pool[slot.index]}), 1);
    const PoolRef to = targets_[slot.index];
    if (!to.valid())
        return;
    __builtin_prefetch(&tree.pool(to), 1);
    if (const ClusterSlot first = tree.pool(to).first; first.valid())
        __builtin_prefetch(&clusters.previous[first.index], 1);
}

void Regrouping::split(SlodTree& tree, UpdateCounts& counts)
{
    if (splitting_.empty())
        return;
    note_held_velocities();
    dissolve_splitting(tree);
    form_dissolved(tree, &Particle::position);
    hold_velocities();
    counts.splits += splitting_.size();
    counts.reformed_members += grouping_.particles.size();
}

/// Of the clusters in `splitting_` that move at their first particle's velocity.
void Regrouping::note_held_velocities()
{
    const ClusterTable& clusters = context_.store.clusters;
    held_.clear();
    if (!clusters.columns.withheld)
        return;
    for (const ClusterSlot slot : splitting_)
        held_.push_back({clusters.velocity[slot.index], clusters.holds_velocity(slot.index)});
}

/// Lets the parts of those move on at that velocity, to where their region ends.
void Regrouping::hold_velocities()
{
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const Grouping::Group& group = grouping_.groups[i];
        for (std::uint32_t part = 0; held_[i].held && part < group.clusters; ++part)
            hold_velocity(context_.store.clusters, grouping_.slots[group.first_slot + part].index,
                          held_[i].velocity);
    }
}

void Regrouping::divide_by_velocity(SlodTree& tree, std::uint64_t frame)
{
    context_.frame = frame;
    measure_surroundings(tree);
    const ClusterTable& clusters = context_.store.clusters;
    const auto mixed = [&](ClusterSlot slot) {
        const RegionRow region = clusters.region[slot.index];
        return clusters.count[slot.index] > 1 && !moves_alike(context_.store, tree.subtrees[region].settings,
                                                              slot, frame, surroundings_[region]);
    };
    for (;;) {
        splitting_.clear();
        for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot)
            if (clusters.alive(slot) && mixed({slot}))
                splitting_.push_back({slot});
        if (splitting_.empty())
            return;
        dissolve_splitting(tree);
        form_dissolved(tree, &Particle::velocity);
    }
}

/// Ends the clusters in `splitting_`; a group of each one's members is divided into as many as its size asks
/// for, two at least.
void Regrouping::dissolve_splitting(SlodTree& tree)
{
    const ClusterTable& clusters = context_.store.clusters;
    grouping_.clear();
    std::uint32_t first = 0;
    for (const ClusterSlot slot : splitting_) {
        const PoolRef pool{clusters.region[slot.index], clusters.pool[slot.index]};
        const std::uint32_t count = clusters.count[slot.index];
        const std::uint32_t parts = clusters_for(count, tree.of(pool).max_cluster_size());
        grouping_.groups.push_back(
            {.pool = pool, .first = first, .count = count, .clusters = std::max(parts, 2U)});
        first += count;
    }
    dissolve(tree, grouping_, splitting_, context_);
}

/// Divides the groups of dissolved clusters by `key`, forms clusters and links each where it is.
void Regrouping::form_dissolved(SlodTree& tree, Vector3d Particle::*key)
{
    for (std::size_t i = 0; i < grouping_.particles.size(); ++i)
        grouping_.place[i] = grouping_.particles[i].*key;
    form_groups_in_order(grouping_, context_);
    link_where_they_are(tree, grouping_, context_);
}

/// Lets the clusters of each merging group go at their common velocity, by mass or, when all are massless, by
/// number: their members keep what they have about it, and just the energy of the clusters' relative motion
/// is lost.
void Regrouping::share_velocities()
{
    ClusterTable& clusters = context_.store.clusters;
    for (const Gathering::Group& group : gathering_.groups) {
        const auto merging = std::span(gathering_.clusters).subspan(group.first, group.clusters);
        const bool massless = std::all_of(merging.begin(), merging.end(),
                                          [&](ClusterSlot slot) { return !(clusters.mass(slot.index) > 0); });
        const auto weight = [&](ClusterSlot slot) {
            return massless ? double(clusters.count[slot.index]) : clusters.mass(slot.index);
        };
        double sum = 0;
        Vector3d momentum(0, 0, 0);
        for (const ClusterSlot slot : merging) {
            sum += weight(slot);
            momentum += weight(slot) * clusters.mean_velocity(slot.index);
        }
        for (const ClusterSlot slot : merging)
            clusters.velocity[slot.index] += momentum / sum - clusters.mean_velocity(slot.index);
    }
}

/// Mean velocity of each region's clusters, or 0 where the paper's own comparison is asked for.
void Regrouping::measure_surroundings(const SlodTree& tree)
{
    const ClusterTable& clusters = context_.store.clusters;
    surroundings_.assign(tree.subtrees.size(), Vector3d(0, 0, 0));
    const auto at_rest = [](const Subtree& subtree) {
        return subtree.settings.velocity_reference == VelocityReference::Rest;
    };
    if (std::all_of(tree.subtrees.begin(), tree.subtrees.end(), at_rest))
        return;
    const std::size_t regions = tree.subtrees.size();
    const std::size_t share = std::max(block, block_count(clusters.slot_count(), most_blocks));
    const std::size_t blocks = block_count(clusters.slot_count(), share);
    rushes_.assign(blocks * regions, {});
    for_each_block(clusters.slot_count(), share, [&](std::size_t first, std::size_t last) {
        Rush* const rushes = &rushes_[first / share * regions];
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            Rush& rush = rushes[clusters.region[slot]];
            rush.velocity += double(clusters.count[slot]) * clusters.velocity[slot];
            rush.particles += clusters.count[slot];
        }
    });
    for (const Subtree& subtree : tree.subtrees) {
        Rush sum;
        for (std::size_t row = subtree.region; row < rushes_.size(); row += regions) {
            sum.velocity += rushes_[row].velocity;
            sum.particles += rushes_[row].particles;
        }
        if (!at_rest(subtree) && sum.particles > 0)
            surroundings_[subtree.region] = sum.velocity / double(sum.particles);
    }
}

void Regrouping::merge(SlodTree& tree, UpdateCounts& counts)
{
    measure_surroundings(tree);
    counts.pair_tests += gathering_.find(tree, context_.store, context_.frame, surroundings_);
    if (gathering_.groups.empty())
        return;
    const ClusterTable& clusters = context_.store.clusters;
    grouping_.clear();
    std::uint32_t first = 0;
    for (const Gathering::Group& group : gathering_.groups) {
        const std::size_t seed = gathering_.clusters[group.first].index;
        grouping_.groups.push_back({.pool = {clusters.region[seed], clusters.pool[seed]},
                                    .first = first,
                                    .count = group.members,
                                    .clusters = group.parts});
        first += group.members;
        counts.merges += group.clusters - group.parts;
    }
    if (merged_velocities_ == MergedVelocities::Collapse)
        share_velocities();
    dissolve(tree, grouping_, gathering_.clusters, context_);
    form_dissolved(tree, &Particle::position);
    counts.reformed_members += first;
}

/// Keeps the k-d trees as fine as the clusters ask for (section 4.2), each subtree for itself.
void Regrouping::revise(SlodTree& tree, UpdateCounts& counts)
{
    revisions_.resize(tree.subtrees.size());
    std::size_t clusters = 0;
    for (const Subtree& subtree : tree.subtrees) {
        Revision& revision = revisions_[subtree.region];
        revision = {.first = clusters};
        for (const Pool& pool : subtree.pools)
            revision.clusters += pool.node.valid() ? pool.clusters : 0;
        clusters += revision.clusters;
    }
    split_memory_.resize(clusters);
    for_each_task(tree.subtrees.size(),
                  [&](std::size_t row) { revise(tree.subtrees[row], revisions_[row]); });
    for (const Revision& revision : revisions_)
        counts.split_keys += revision.keys;
}

/// A pool in its turn, and at once where a region has come or changed its cells and its clusters are all in a
/// few leaves. By clusters that have left its leaf it cannot be divided.
bool Regrouping::to_be_revised(const Subtree& subtree, std::uint32_t pool) const
{
    if (!subtree.pools[pool].node.valid())
        return false;
    if (turns_.all_at_once())
        return (pool + context_.frame) % revision_period == 0 || flooded(subtree, pool);
    return turns_.has(subtree, pool) && holds_all(subtree, context_.store.clusters, pool);
}

void Regrouping::revise(Subtree& subtree, Revision& revision)
{
    ClusterTable& clusters = context_.store.clusters;
    const auto least = std::uint32_t(sparse * subtree.pool_limit());
    const double most = crowded * subtree.pool_limit();
    const SplitScratch scratch = split_memory_.slice(revision.first, revision.clusters);
    for (std::uint32_t pool = 0; pool < subtree.pools.size(); ++pool) { // grows
        if (!to_be_revised(subtree, pool))
            continue;
        if (subtree.pools[pool].members < least)
            prune(subtree, clusters, {pool}, least);
        else
            revision.keys += expand_crowded(subtree, clusters, {pool}, most, scratch);
    }
}

} // namespace slod
