#include "effects/emission.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/parallel.hpp"

namespace slod {
namespace {

/// Of the newborns that the keys name.
double mean_age(std::span<const DivisionKey> keys, std::span<const Newborn> newborns)
{
    double sum = 0;
    for (const DivisionKey& key : keys)
        sum += newborns[key.index].age;
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
    : emitters_(std::move(emitters)), fields_(fields), mid_life_(mid_life), colliders_(colliders), air_(air),
      sinks_(sinks), cohorts_(emitters_.size())
{}

Emission::Births Emission::update(SlodTree& tree, const UpdateContext& context, double closing_kick,
                                  std::uint64_t room)
{
    Births births;
    new_clusters_.clear();
    for (std::size_t emitter = 0; emitter < emitters_.size(); ++emitter) {
        newborns_.clear();
        births.refused += emitters_[emitter].emit(context.frame, context.step, fields_, room - births.born,
                                                  newborns_, colliders_, air_);
        if (sinks_ != nullptr)
            std::erase_if(newborns_, [&](const Newborn& born) {
                return sinks_->meet(born.from, born.particle.position);
            });
        births.born += newborns_.size();
        const std::size_t joined = join_cohort(tree, cohorts_[emitter], context, closing_kick);
        if (joined < newborns_.size())
            found(tree, emitter, joined, context);
    }
    return births;
}

/// Puts the first newborns into the open cluster as far as it has room; returns how many.
std::size_t Emission::join_cohort(SlodTree& tree, ClusterId cohort, const UpdateContext& context,
                                  double closing_kick)
{
    ClusterTable& clusters = context.store.clusters;
    const std::size_t slot = cohort.slot.index;
    if (!cohort.slot.valid() || !clusters.alive(slot) || clusters.generation[slot] != cohort.generation)
        return 0;
    const PoolRef pool{clusters.region[slot], clusters.pool[slot]};
    if (!takes_members(context.store, cohort.slot, context.frame))
        return 0;
    const std::uint32_t most = std::min(tree.of(pool).growth_limit(), clusters.slab[slot].capacity);
    const std::size_t room = most - std::min(most, clusters.stored[slot]);
    const std::size_t joining = std::min(newborns_.size(), room);
    const Vector3d first_velocity = clusters.velocity[slot];
    for (std::size_t i = 0; i < joining; ++i) {
        Newborn& born = newborns_[i];
        // The closing kick will act on it, too; the newborn was there for its age.
        if (closing_kick > 0)
            born.particle.velocity += (born.age - closing_kick) * clusters.acceleration[slot];
        insert_member(context.store, cohort.slot, born.particle, context.frame);
    }
    if (by_first_particle(tree, clusters, slot))
        hold_velocity(clusters, slot, first_velocity);
    tree.pool(pool).members += std::uint32_t(joining);
    return joining;
}

/// Forms clusters of the newborns from `first` on. A single one that is not full stays open as the cohort.
void Emission::found(SlodTree& tree, std::size_t emitter, std::size_t first, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    const auto count = std::uint32_t(newborns_.size() - first);
    const double lifetime = emitters_[emitter].settings().lifetime;
    const double ahead = std::isfinite(lifetime) ? 0.5 * lifetime : mid_life_;
    const std::span<const Newborn> founders = std::span(newborns_).subspan(first);
    grouping_.clear();
    grouping_.resize(count);
    for_each_block(count, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Particle& particle = grouping_.particles[i] = founders[i].particle;
            grouping_.place[i] = particle.position + ahead * particle.velocity;
        }
    });
    const Particle& founder = grouping_.particles.front();
    const RegionRow region =
        tree.region_at({founder.position, double(founder.mass), founder.velocity.norm()});
    const std::uint32_t most = tree.subtrees[region].growth_limit();
    const std::uint32_t parts = clusters_for(count, most);
    const bool open = parts == 1 && count < most;
    grouping_.groups.push_back(
        {.pool = {region, {}}, .count = count, .clusters = parts, .spare_rows = open ? most - count : 0});
    form_groups_in_order(grouping_, context);
    link_where_they_are(tree, grouping_, context);
    const std::size_t before = new_clusters_.size();
    new_clusters_.resize(before + parts);
    for_each_block(parts, 16, [&](std::size_t begin, std::size_t end) {
        for (auto part = std::uint32_t(begin); part < end; ++part) {
            const std::size_t slot = grouping_.slots[part].index;
            const auto keys = std::span<const DivisionKey>(grouping_.keys)
                                  .subspan(part_begin(count, parts, part), clusters.count[slot]);
            if (by_first_particle(tree, clusters, slot)) // which comes first in its part, too
                hold_velocity(clusters, slot, founders[keys.front().index].particle.velocity);
            new_clusters_[before + part] = {clusters.id(slot), mean_age(keys, founders)};
        }
    });
    cohorts_[emitter] = open ? clusters.id(grouping_.slots.front().index) : ClusterId{};
}

std::vector<std::uint64_t> Emission::counts_before(double time) const
{
    std::vector<std::uint64_t> counts;
    for (const Emitter& emitter : emitters_)
        counts.push_back(emitter.count_before(time));
    return counts;
}

} // namespace slod
