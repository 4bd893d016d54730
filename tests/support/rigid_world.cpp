#include "support/rigid_world.hpp"

#include <cmath>

#include "tree/reforming.hpp"

namespace slod::test {
namespace {

double cell_side(const RigidRules& rules)
{
    return std::isfinite(rules.background.max_breadth) ? rules.background.max_breadth : rules.cell_side;
}

} // namespace

RigidWorld::RigidWorld(const RigidRules& rules, const ParticleSet& particles, bool singly)
    : world_({MapKind::Identity, 0, step}, {}, rules.background, cell_side(rules)),
      regrouping_(rules.motion, world_.context(0))
{
    for (const RegionOfInterest& region : rules.regions)
        open_region(world_.tree, region);
    settle(world_.tree);
    world_.tree.merging = rules.merging;
    if (singly) {
        for (const Particle& particle : particles)
            world_.add({particle});
    } else if (!particles.empty()) {
        Reforming(rules.motion, world_.context(0)).found(world_.tree, particles, 0, Reforming::Strays::None);
        if (rules.motion.build_respects_limits)
            regrouping_.divide_by_velocity(world_.tree, 0);
    }
}

void RigidWorld::advance()
{
    ++frame;
    ClusterTable& clusters = world_.store.clusters;
    for (const ClusterSlot slot : alive())
        clusters.position[slot.index] += step * clusters.velocity[slot.index];
    world_.store.members.recycle(frame);
    if (world_.tree.unsettled)
        settle(world_.tree);
    counts = {};
    regrouping_.update(world_.tree, frame, counts);
}

void RigidWorld::advance(int frames)
{
    for (int i = 0; i < frames; ++i)
        advance();
}

std::vector<ClusterSlot> RigidWorld::alive() const
{
    std::vector<ClusterSlot> slots;
    for (std::uint32_t slot = 0; slot < clusters().slot_count(); ++slot)
        if (clusters().alive(slot))
            slots.push_back({slot});
    return slots;
}

ParticleSet RigidWorld::members(ClusterSlot slot) const
{
    return test::members(world_.store, slot, frame);
}

ParticleSet RigidWorld::particles() const
{
    return test::members(world_.store, frame);
}

std::vector<ClusterSlot> RigidWorld::cluster_of_particles() const
{
    std::vector<ClusterSlot> found(particles().size());
    for (const ClusterSlot slot : alive())
        for (const Particle& particle : members(slot))
            found.at(particle.id - 1) = slot;
    return found;
}

} // namespace slod::test
