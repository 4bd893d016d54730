#include "support/little_worlds.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace slod::test {
namespace {

void sort_by_id(ParticleSet& particles)
{
    std::sort(particles.begin(), particles.end(),
              [](const Particle& a, const Particle& b) { return a.id < b.id; });
}

} // namespace

ClusterStore empty_store(const MapRule& rule, const Features& features)
{
    ClusterStore store({.map = rule.kind == MapKind::Full,
                        .tide = true,
                        .acceleration = true,
                        .counting_moments = features.masses,
                        .expiry = features.expiry,
                        .withheld = features.withheld},
                       {.mass = features.masses, .kind = features.kinds, .expiry = features.expiry}, rule);
    store.uniform_mass = 1;
    store.kind_softening_squared = {0.01, 0.04, 0.16};
    return store;
}

ClusterSlot form(ClusterStore& store, ParticleSet particles, std::uint64_t frame, std::uint32_t spare)
{
    const ClusterSlot slot = store.clusters.take_slot();
    store.clusters.slab[slot.index] = store.members.allocate(std::uint32_t(particles.size()) + spare);
    form_cluster(store, slot, particles, frame);
    return slot;
}

ParticleSet members(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame)
{
    ParticleSet particles(store.clusters.count[slot.index]);
    map_out(store, slot, frame, particles);
    sort_by_id(particles);
    return particles;
}

ParticleSet members(const ClusterStore& store, std::uint64_t frame)
{
    ParticleSet all;
    for (std::uint32_t slot = 0; slot < store.clusters.slot_count(); ++slot) {
        if (!store.clusters.alive(slot))
            continue;
        const ParticleSet own = members(store, ClusterSlot{slot}, frame);
        all.insert(all.end(), own.begin(), own.end());
    }
    sort_by_id(all);
    return all;
}

FlowMap aged_map(const MapRule& rule, std::uint64_t frames, double tide, std::uint64_t seed)
{
    Random random(seed, 2, 0);
    const auto number = [&] { return tide * (2 * random.uniform() - 1); };
    const Propagator step{
        std::expm1(-rule.drag * rule.step), drag_drift(rule.drag, rule.step), {0, 0, 0}, {0, 0, 0}};
    FlowMap map;
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        const Symmetric3 pull{number(), number(), number(), number(), number(), number()};
        kick(map, rule.step, pull);
        propagate(map, step);
    }
    return map;
}

World::World(const MapRule& rule, const Features& features, const RegionSettings& region_settings,
             double cell_side)
    : store(empty_store(rule, features)), tree(region_settings, cell_side)
{}

ClusterSlot World::add(const ParticleSet& particles, std::uint64_t frame, std::uint32_t spare)
{
    const ClusterSlot slot = form(store, particles, frame, spare);
    const PoolRef pool = locate_or_grow(tree, subject_of(store.clusters, slot.index));
    link(tree.of(pool), store.clusters, pool.pool, slot);
    return slot;
}

} // namespace slod::test
