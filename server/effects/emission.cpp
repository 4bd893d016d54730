#include "effects/emission.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::size_t brood_block = 256; ///< newborns of a task

/// Of the newborns that the keys name.
double mean_age(std::span<const DivisionKey> keys, std::span<const double> ages)
{
    double sum = 0;
    for (const DivisionKey& key : keys)
        sum += ages[key.index];
    return sum / double(keys.size());
}

bool by_first_particle(const SlodTree& tree, const ClusterTable& clusters, std::size_t slot)
{
    return clusters.columns.withheld &&
           tree.subtrees[clusters.region[slot]].settings.cluster_velocity == ClusterVelocity::First;
}

} // namespace

Emission::Emission(std::vector<Emitter> emitters, const UniformFields& fields, double mid_life,
                   const Colliders* colliders, const Air* air, const Sinks* sinks)
    : emitters_(std::move(emitters)), surroundings_{fields, colliders, air}, mid_life_(mid_life),
      sinks_(sinks), cohorts_(emitters_.size()), broods_(emitters_.size())
{}

Emission::Births Emission::update(SlodTree& tree, const UpdateContext& context, double closing_kick,
                                  std::uint64_t room)
{
    const Births births = write_newborns(context, room);
    grouping_.order.clear();
    grouping_.groups.clear();
    founders_.clear();
    for (std::size_t emitter = 0; emitter < emitters_.size(); ++emitter) {
        const std::size_t joined = join_cohort(tree, emitter, context, closing_kick);
        if (joined < broods_[emitter].count)
            gather(tree, emitter, joined);
    }
    found(tree, context);
    return births;
}

/// Writes all newborns of the frame, emitter by emitter.
Emission::Births Emission::write_newborns(const UpdateContext& context, std::uint64_t room)
{
    Births births;
    std::size_t total = 0;
    for (std::size_t emitter = 0; emitter < emitters_.size(); ++emitter) {
        const Emitter::Starts starts = emitters_[emitter].starts_in(context.frame, context.step);
        const std::size_t count = std::min(starts.count, room - total);
        broods_[emitter] = {starts, total, count};
        births.refused += starts.count - count;
        total += count;
    }
    grouping_.resize(total);
    ages_.resize(total);
    const bool all_live = holds_in_blocks(total, brood_block, [&](std::size_t first, std::size_t last) {
        std::array<Newborn, brood_block> block;
        bool live = true;
        for (std::size_t emitter = 0; emitter < broods_.size(); ++emitter) {
            const Brood& brood = broods_[emitter];
            const std::size_t begin = std::max(first, brood.first);
            const std::size_t end = std::min(last, brood.first + brood.count);
            if (begin < end)
                live = write_newborns(emitter, begin, std::span(block).first(end - begin)) && live;
        }
        return live;
    });
    if (!all_live)
        leave_out_dead(context.frame);
    births.born = grouping_.particles.size();
    return births;
}

/// Writes an emitter's newborns from `begin` of all on, by way of `newborns`; returns whether they all
/// outlive the frame.
bool Emission::write_newborns(std::size_t emitter, std::size_t begin, std::span<Newborn> newborns)
{
    const Brood& brood = broods_[emitter];
    const double lifetime = emitters_[emitter].settings().lifetime;
    const double ahead = std::isfinite(lifetime) ? 0.5 * lifetime : mid_life_;
    emitters_[emitter].bear(brood.starts, begin - brood.first, surroundings_, newborns);
    bool live = true;
    for (std::size_t i = 0; i < newborns.size(); ++i) {
        Particle& particle = newborns[i].particle;
        if (sinks_ != nullptr && sinks_->meet(newborns[i].from, particle.position))
            particle.expiry_frame = std::uint32_t(brood.starts.frame);
        live = live && particle.expiry_frame > brood.starts.frame;
        grouping_.particles[begin + i] = particle;
        grouping_.place[begin + i] = particle.position + ahead * particle.velocity;
        ages_[begin + i] = newborns[i].age;
    }
    return live;
}

/// Closes the ranks of the others.
void Emission::leave_out_dead(std::uint64_t frame)
{
    std::size_t kept = 0;
    for (Brood& brood : broods_) {
        const std::size_t begin = brood.first, end = begin + brood.count;
        brood.first = kept;
        for (std::size_t i = begin; i < end; ++i) {
            if (grouping_.particles[i].expiry_frame <= frame)
                continue;
            grouping_.particles[kept] = grouping_.particles[i];
            grouping_.place[kept] = grouping_.place[i];
            ages_[kept++] = ages_[i];
        }
        brood.count = kept - brood.first;
    }
    grouping_.resize(kept);
    ages_.resize(kept);
}

/// Puts the first newborns into the emitter's open cluster as far as it has room; returns how many.
std::size_t Emission::join_cohort(SlodTree& tree, std::size_t emitter, const UpdateContext& context,
                                  double closing_kick)
{
    const ClusterId cohort = cohorts_[emitter];
    const Brood& brood = broods_[emitter];
    ClusterTable& clusters = context.store.clusters;
    const std::size_t slot = cohort.slot.index;
    if (!cohort.slot.valid() || !clusters.alive(slot) || clusters.generation[slot] != cohort.generation)
        return 0;
    const PoolRef pool{clusters.region[slot], clusters.pool[slot]};
    if (!takes_members(context.store, cohort.slot, context.frame))
        return 0;
    const std::uint32_t most = std::min(tree.of(pool).growth_limit(), clusters.slab[slot].capacity);
    const std::size_t room = most - std::min(most, clusters.stored[slot]);
    const std::size_t joining = std::min(brood.count, room);
    const Vector3d first_velocity = clusters.velocity[slot];
    for (std::size_t i = brood.first; i < brood.first + joining; ++i) {
        Particle& particle = grouping_.particles[i];
        // The closing kick will act on it, too; the newborn was there for its age.
        if (closing_kick > 0)
            particle.velocity += (ages_[i] - closing_kick) * clusters.acceleration[slot];
        insert_member(context.store, cohort.slot, particle, context.frame);
    }
    if (by_first_particle(tree, clusters, slot))
        hold_velocity(clusters, slot, first_velocity);
    tree.pool(pool).members += std::uint32_t(joining);
    return joining;
}

/// The emitter's newborns but the first `joined` are to found clusters, in the region of the first of them. A
/// single cluster that is not full keeps rows for others to join.
void Emission::gather(const SlodTree& tree, std::size_t emitter, std::size_t joined)
{
    const Brood& brood = broods_[emitter];
    const std::size_t first = brood.first + joined;
    const auto count = std::uint32_t(brood.count - joined);
    const Particle& founder = grouping_.particles[first];
    const RegionRow region =
        tree.region_at({founder.position, double(founder.mass), founder.velocity.norm()});
    const std::uint32_t most = tree.subtrees[region].growth_limit();
    const std::uint32_t parts = clusters_for(count, most);
    grouping_.groups.push_back({.pool = {region, {}},
                                .first = std::uint32_t(grouping_.order.size()),
                                .count = count,
                                .clusters = parts,
                                .spare_rows = parts == 1 ? most - count : 0});
    founders_.push_back(emitter);
    grouping_.order.resize(grouping_.order.size() + count);
    std::iota(grouping_.order.end() - count, grouping_.order.end(), std::uint32_t(first));
}

/// Forms the clusters of all groups, and keeps those with spare rows open as their emitters' cohorts.
void Emission::found(SlodTree& tree, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    form_groups(grouping_, context);
    link_where_they_are(tree, grouping_, context);
    new_clusters_.resize(grouping_.slots.size());
    for (std::size_t group = 0; group < founders_.size(); ++group) {
        const Grouping::Group& formed = grouping_.groups[group];
        note_new_clusters(tree, formed, clusters);
        const bool open = formed.spare_rows > 0;
        cohorts_[founders_[group]] =
            open ? clusters.id(grouping_.slots[formed.first_slot].index) : ClusterId{};
    }
}

void Emission::note_new_clusters(const SlodTree& tree, const Grouping::Group& group, ClusterTable& clusters)
{
    for_each_block(group.clusters, 64, [&](std::size_t begin, std::size_t end) {
        for (auto part = std::uint32_t(begin); part < end; ++part) {
            const std::size_t slot = grouping_.slots[group.first_slot + part].index;
            const auto keys = std::span<const DivisionKey>(grouping_.keys)
                                  .subspan(group.first + part_begin(group.count, group.clusters, part),
                                           clusters.count[slot]);
            if (by_first_particle(tree, clusters, slot)) // which comes first in its part, too
                hold_velocity(clusters, slot, grouping_.particles[keys.front().index].velocity);
            new_clusters_[group.first_slot + part] = {clusters.id(slot), mean_age(keys, ages_)};
        }
    });
}

std::vector<std::uint64_t> Emission::counts_before(double time) const
{
    std::vector<std::uint64_t> counts;
    for (const Emitter& emitter : emitters_)
        counts.push_back(emitter.count_before(time));
    return counts;
}

} // namespace slod
