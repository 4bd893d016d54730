#include <gtest/gtest.h>

#include "cluster/conserved.hpp"
#include "cluster/forming.hpp"
#include "core/random.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

constexpr double double_rounding = 0x1p-53;
constexpr std::uint64_t age = 10;

class ExpiryByMap : public testing::TestWithParam<MapKind> {
protected:
    MapRule rule{GetParam(), GetParam() == MapKind::Identity ? 0 : 0.3, 0.05};
    ClusterStore store = test::empty_store(rule, {.masses = true, .kinds = true, .expiry = true});

    ClusterSlot aged_cluster(const ParticleSet& particles, std::uint32_t spare = 0)
    {
        const ClusterSlot slot = test::form(store, particles, 0, spare);
        if (rule.kind == MapKind::Full)
            store.clusters.map[slot.index] = test::aged_map(rule, age, 1, 2);
        return slot;
    }

    /// 60 particles of three kinds whose lives end at the frames after `age`, five at each.
    static ParticleSet mortals()
    {
        ParticleSet particles = test::ball(60, 2, 1, 1, {5, -3, 8});
        test::give_masses(particles, 0.01, 100, 1);
        for (Particle& particle : particles) {
            particle.expiry_frame = std::uint32_t(age + 1 + particle.id * 7 % 12);
            particle.kind = std::uint8_t(particle.id % 3);
        }
        return particles;
    }
};

INSTANTIATE_TEST_SUITE_P(Maps, ExpiryByMap,
                         testing::Values(MapKind::Identity, MapKind::Scalar, MapKind::Full),
                         [](const auto& kind) {
                             return std::string(names(kind.param)[std::size_t(kind.param)]);
                         });

/// Those of `particles` that outlive `frame`.
ParticleSet survivors(ParticleSet particles, std::uint64_t frame)
{
    std::erase_if(particles, [&](const Particle& particle) { return particle.expiry_frame <= frame; });
    return particles;
}

/// `found` are `expected` to double rounding of places at 10 from the origin and sums of 60 terms.
void expect_same(const ParticleSet& found, const ParticleSet& expected)
{
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].id, expected[i].id);
        EXPECT_LE((found[i].position - expected[i].position).norm(), 10 * 60 * double_rounding);
        EXPECT_LE((found[i].velocity - expected[i].velocity).norm(), 10 * 60 * double_rounding);
    }
}

// The map is kept as it is at frame `age`, so that only the deaths can change anything.
TEST_P(ExpiryByMap, DeathsMoveNoSurvivor)
{
    const ClusterSlot slot = aged_cluster(mortals());
    const ParticleSet all = test::members(store, slot, age);
    for (std::uint64_t frame = age + 1; frame < age + 12; ++frame) {
        store.clusters.formed_frame[slot.index] = frame - age; // the age of the map stays the same
        EXPECT_EQ(remove_expired(store, slot, frame), 5U);
        expect_same(test::members(store, slot, frame), survivors(all, frame));
    }
    EXPECT_EQ(remove_expired(store, slot, age + 12), 5U);
    EXPECT_FALSE(store.clusters.alive(slot.index));
}

// What is left has the sums, centre and softening of a cluster that never had the others.
TEST_P(ExpiryByMap, DeathsLeaveTheMomentsOfTheSurvivors)
{
    const ClusterSlot slot = aged_cluster(mortals());
    const std::uint64_t last = age + 11;
    for (std::uint64_t frame = age + 1; frame <= last; ++frame)
        remove_expired(store, slot, frame);
    const Moments& left = store.clusters.moments[slot.index];
    const Moments& counted = store.clusters.counting[slot.index];
    Moments mass, number;
    double softening = 0;
    const Slab& slab = store.clusters.slab[slot.index];
    for (std::uint32_t row = 0; row < 60; ++row) {
        if (store.members.expiries(slab)[row] <= last)
            continue;
        const FormedOffset& offset = store.members.offsets(slab)[row];
        const double m = double(store.members.masses(slab)[row]);
        mass.add(m, offset.position.cast<double>(), offset.velocity.cast<double>());
        number.add(1, offset.position.cast<double>(), offset.velocity.cast<double>());
        softening += m * store.kind_softening_squared[store.members.kinds(slab)[row]];
    }
    EXPECT_NEAR(left.weight, mass.weight, 1e-12 * mass.weight);
    EXPECT_LE((left.o - mass.o).norm(), 1e-12 * mass.weight);
    EXPECT_LE((left.oo.matrix() - mass.oo.matrix()).norm(), 1e-12 * mass.oo.trace());
    EXPECT_LE((left.ww.matrix() - mass.ww.matrix()).norm(), 1e-12 * mass.ww.trace());
    EXPECT_LE((left.ow - mass.ow).norm(), 1e-12 * mass.weight);
    EXPECT_EQ(counted.weight, 5);
    EXPECT_LE((counted.oo.matrix() - number.oo.matrix()).norm(), 1e-12 * number.oo.trace());
    EXPECT_FLOAT_EQ(store.clusters.softening_squared[slot.index], float(softening / mass.weight));
}

TEST_P(ExpiryByMap, DeathsTakeTheirMassMomentumAndEnergyAlong)
{
    const ClusterSlot slot = aged_cluster(mortals());
    const ParticleSet all = test::members(store, slot, age);
    store.clusters.formed_frame[slot.index] = 3;
    remove_expired(store, slot, age + 3);
    const ConservedQuantities left = conserved_quantities(store, slot.index, age + 3);
    double mass = 0, energy = 0;
    Vector3d momentum{0, 0, 0};
    for (const Particle& particle : survivors(all, age + 3)) {
        mass += double(particle.mass);
        momentum += double(particle.mass) * particle.velocity;
        energy += 0.5 * double(particle.mass) * particle.velocity.squaredNorm();
    }
    EXPECT_NEAR(left.mass, mass, 1e-12 * mass);
    EXPECT_LE((left.momentum - momentum).norm(), 1e-12 * mass);
    EXPECT_NEAR(left.kinetic_energy, energy, 1e-12 * energy);
}

// Were the dead subtracted from the sums, 1e-9 would be lost in the rounding of 1e9.
TEST_P(ExpiryByMap, ALightSurvivorOfAHeavyMemberKeepsItsPlaceAndMass)
{
    ParticleSet particles = test::ball(3, 2, 1, 1, {5, -3, 8});
    particles[0].mass = 1e9F;
    particles[0].expiry_frame = std::uint32_t(age);
    particles[1].mass = 1e-9F;
    particles[2].mass = 0;
    const ClusterSlot slot = aged_cluster(particles);
    ParticleSet expected = test::members(store, slot, age - 1);
    store.clusters.formed_frame[slot.index] = 1;
    remove_expired(store, slot, age);
    expect_same(test::members(store, slot, age), survivors(expected, age));
    EXPECT_EQ(store.clusters.mass(slot.index), double(1e-9F));
}

TEST_P(ExpiryByMap, OnlyTheMasslessAreLeftInTheirPlaces)
{
    ParticleSet particles = test::ball(6, 2, 1, 1, {5, -3, 8});
    for (Particle& particle : particles) {
        particle.mass = particle.id <= 3 ? 0.1F * float(particle.id) : 0;
        particle.expiry_frame = particle.id <= 3 ? std::uint32_t(age) : Particle::never;
    }
    const ClusterSlot slot = aged_cluster(particles);
    const ParticleSet expected = survivors(test::members(store, slot, age - 1), age);
    store.clusters.formed_frame[slot.index] = 1;
    remove_expired(store, slot, age);
    expect_same(test::members(store, slot, age), expected);
    EXPECT_EQ(store.clusters.mass(slot.index), 0);
}

TEST_P(ExpiryByMap, AMemberDiesOnceAndTheNextExpiryIsTheEarliestToCome)
{
    ParticleSet particles = test::ball(4, 2, 1, 1);
    for (Particle& particle : particles)
        particle.expiry_frame = std::uint32_t(20 + particle.id); // 21 .. 24
    const ClusterSlot slot = aged_cluster(particles, 1);
    EXPECT_EQ(store.clusters.next_expiry[slot.index], 21U);
    EXPECT_EQ(remove_expired(store, slot, 20), 0U);
    EXPECT_EQ(remove_expired(store, slot, 22), 2U);
    EXPECT_EQ(remove_expired(store, slot, 22), 0U);
    EXPECT_EQ(store.clusters.next_expiry[slot.index], 23U);
    Particle newcomer = particles.front();
    newcomer.id = 50;
    newcomer.expiry_frame = 30;
    insert_member(store, slot, newcomer, 22);
    EXPECT_EQ(store.clusters.next_expiry[slot.index], 23U);
    EXPECT_EQ(remove_expired(store, slot, 24), 2U);
    EXPECT_EQ(store.clusters.next_expiry[slot.index], 30U);
    EXPECT_EQ(store.clusters.count[slot.index], 1U);
}

} // namespace
} // namespace slod
