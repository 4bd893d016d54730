#include <cmath>

#include <gtest/gtest.h>

#include "cluster/bounds.hpp"
#include "cluster/conserved.hpp"
#include "cluster/forming.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/totals.hpp"

namespace slod {
namespace {

constexpr double float_rounding = 0x1p-24;
constexpr double double_rounding = 0x1p-53;
constexpr std::uint64_t age = 32;

/// Largest distance and velocity difference of particles of the same id.
struct Deviation {
    double position = 0, velocity = 0;
};

Deviation deviation(const ParticleSet& found, const ParticleSet& expected)
{
    EXPECT_EQ(found.size(), expected.size());
    Deviation largest;
    for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
        EXPECT_EQ(found[i].id, expected[i].id);
        largest.position = std::max(largest.position, (found[i].position - expected[i].position).norm());
        largest.velocity = std::max(largest.velocity, (found[i].velocity - expected[i].velocity).norm());
    }
    return largest;
}

const MapRule identity{MapKind::Identity, 0, 0.05};

TEST(FormCluster, CentreAndVelocityAreTheMeansByMass)
{
    ClusterStore store = test::empty_store(identity);
    ParticleSet particles = test::ball(50, 2, 3, 1, {4, 5, 6});
    test::give_masses(particles, 0.1, 10, 1);
    const ClusterSlot slot = test::form(store, particles);
    const ConservedQuantities total = test::totals(particles);
    Vector3d centre{0, 0, 0};
    for (const Particle& particle : particles)
        centre += double(particle.mass) / total.mass * particle.position;
    // Sums of 50 terms of up to 10 in size.
    EXPECT_LE((store.clusters.position[slot.index] - centre).norm(), 50 * 10 * double_rounding);
    EXPECT_LE((store.clusters.velocity[slot.index] - total.momentum / total.mass).norm(),
              50 * 3 * double_rounding);
    EXPECT_EQ(store.clusters.mass(slot.index), total.mass);
    EXPECT_EQ(store.clusters.count[slot.index], 50U);
}

TEST(FormCluster, G24_MasslessParticlesAreCentredByNumber)
{
    ClusterStore store = test::empty_store(identity);
    ParticleSet particles = test::ball(3, 1, 1, 1);
    for (Particle& particle : particles)
        particle.mass = 0;
    const ClusterSlot slot = test::form(store, particles);
    const Vector3d centre = (particles[0].position + particles[1].position + particles[2].position) / 3;
    test::expect_at_most("distance of the centre from the mean place",
                         (store.clusters.position[slot.index] - centre).norm(), 4 * double_rounding);
    EXPECT_EQ(store.clusters.mass(slot.index), 0);
}

// An offset is rounded to float, by at most float_rounding of itself, and the mean of the stored offsets,
// which the map is applied about, by the mean of that. The centre is lost to double rounding of the place.
TEST(FormCluster, MembersComeBackWithinAFloatRoundingOfTheirOffsets)
{
    for (const double place : {0.0, 1.0, 1e7, 1e12}) {
        ClusterStore store = test::empty_store(identity);
        ParticleSet particles = test::ball(100, 2, 3, 1, {place, -place, 0.5 * place});
        test::give_masses(particles, 0.1, 10, 1);
        const ClusterSlot slot = test::form(store, particles);
        const Deviation moved = deviation(test::members(store, slot, 0), particles);
        EXPECT_LE(moved.position, 2 * float_rounding * 4 + 100 * place * double_rounding) << "at " << place;
        EXPECT_LE(moved.velocity, 2 * float_rounding * 6) << "at " << place;
    }
}

TEST(FormCluster, EveryPropertyOfAMemberComesBack)
{
    ClusterStore store = test::empty_store(identity, {.masses = true, .kinds = true, .expiry = true});
    ParticleSet particles = test::ball(20, 1, 1, 1);
    for (Particle& particle : particles) {
        particle.id = (particle.id << 40) + 7;
        particle.mass = float(particle.id % 11);
        particle.kind = std::uint8_t(particle.id % 3);
        particle.expiry_frame = 100 - std::uint32_t(particle.id % 17);
    }
    const ParticleSet found = test::members(store, test::form(store, particles, 3), 3);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        EXPECT_EQ(found[i].id, particles[i].id);
        EXPECT_EQ(found[i].mass, particles[i].mass);
        EXPECT_EQ(found[i].kind, particles[i].kind);
        EXPECT_EQ(found[i].expiry_frame, particles[i].expiry_frame);
    }
}

TEST(FormCluster, ColumnsThatAreAbsentHaveTheirCommonValue)
{
    ClusterStore store = test::empty_store(identity, {.masses = false});
    store.uniform_mass = 2.5F;
    ParticleSet particles = test::ball(4, 1, 1, 1);
    for (Particle& particle : particles)
        particle.mass = 2.5F;
    const ClusterSlot slot = test::form(store, particles);
    for (const Particle& particle : test::members(store, slot, 0)) {
        EXPECT_EQ(particle.mass, 2.5F);
        EXPECT_EQ(particle.kind, 0);
        EXPECT_EQ(particle.expiry_frame, Particle::never);
    }
    EXPECT_EQ(store.clusters.mass(slot.index), 10);
}

TEST(FormCluster, SofteningIsTheMassWeightedMeanOfTheKinds)
{
    ClusterStore store =
        test::empty_store(identity, {.masses = true, .kinds = true}); // eps^2: 0.01, 0.04, 0.16
    ParticleSet particles = test::ball(3, 1, 1, 1);
    particles[0].mass = 1;
    particles[1].mass = 3;
    particles[2].mass = 0;
    particles[1].kind = 1;
    particles[2].kind = 2;
    const ClusterSlot slot = test::form(store, particles);
    EXPECT_FLOAT_EQ(store.clusters.softening_squared[slot.index], (0.01F + 3 * 0.04F) / 4);
    for (Particle& particle : particles)
        particle.mass = 0;
    EXPECT_FLOAT_EQ(store.clusters.softening_squared[test::form(store, particles).index], 0.01F);
}

/// Each kind of map, aged.
class FormingByMap : public testing::TestWithParam<MapKind> {
protected:
    MapRule rule{GetParam(), GetParam() == MapKind::Identity ? 0 : 0.3, 0.05};
    ClusterStore store = test::empty_store(rule, {.masses = true, .kinds = true});

    ClusterSlot aged_cluster(const ParticleSet& particles, std::uint32_t spare)
    {
        const ClusterSlot slot = test::form(store, particles, 0, spare);
        if (rule.kind == MapKind::Full)
            store.clusters.map[slot.index] = test::aged_map(rule, age, 1, 2);
        return slot;
    }

    /// How far the map and its inverse together magnify a rounding of an offset.
    double magnification(ClusterSlot slot) const
    {
        const MapBlocks map = store.clusters.blocks(slot.index, rule, age);
        const double size = map.a.norm() + map.b.norm() + map.c.norm() + map.d.norm();
        return size * size / map.decay;
    }
};

INSTANTIATE_TEST_SUITE_P(Maps, FormingByMap,
                         testing::Values(MapKind::Identity, MapKind::Scalar, MapKind::Full),
                         [](const auto& kind) {
                             return std::string(names(kind.param)[std::size_t(kind.param)]);
                         });

// The newcomer's offset at forming is rounded to float, and everybody is moved by the means of the roundings.
TEST_P(FormingByMap, AnInsertedParticleComesBackAndNobodyElseMoves)
{
    ParticleSet particles = test::ball(40, 2, 1, 1, {5, -3, 8});
    test::give_masses(particles, 0.5, 3, 1);
    const ClusterSlot slot = aged_cluster(particles, 10);
    ParticleSet expected = test::members(store, slot, age);
    for (std::uint64_t i = 0; i < 10; ++i) {
        Particle newcomer = test::ball(1, 3, 2, 100 + i, store.clusters.position[slot.index]).front();
        newcomer.id = 1000 + i;
        newcomer.mass = float(i);
        newcomer.kind = 2;
        insert_member(store, slot, newcomer, age);
        expected.push_back(newcomer);
    }
    const ParticleSet found = test::members(store, slot, age);
    const Deviation moved = deviation(found, expected);
    EXPECT_LE(moved.position, 2 * float_rounding * 5 * magnification(slot));
    EXPECT_LE(moved.velocity, 2 * float_rounding * 5 * magnification(slot));
    EXPECT_EQ(found.back().mass, 9);
    EXPECT_EQ(found.back().kind, 2);
}

TEST_P(FormingByMap, InsertionConservesMassAndMomentumToDoubleRounding)
{
    ParticleSet particles = test::ball(40, 2, 1, 1, {5, -3, 8});
    const ClusterSlot slot = aged_cluster(particles, 1);
    const ConservedQuantities before = conserved_quantities(store, slot.index, age);
    Particle newcomer = test::ball(1, 3, 2, 7, {5, -3, 8}).front();
    newcomer.mass = 5;
    insert_member(store, slot, newcomer, age);
    const ConservedQuantities after = conserved_quantities(store, slot.index, age);
    EXPECT_EQ(after.mass, before.mass + 5);
    EXPECT_LE((after.momentum - before.momentum - 5 * newcomer.velocity).norm(),
              8 * after.mass * double_rounding);
}

TEST_P(FormingByMap, InsertionAmongTheMasslessMovesNobody)
{
    ParticleSet particles = test::ball(5, 2, 1, 1);
    for (Particle& particle : particles)
        particle.mass = 0;
    const ClusterSlot slot = aged_cluster(particles, 2);
    ParticleSet expected = test::members(store, slot, age);
    for (const float mass : {0.0F, 1.0F}) { // then the centre is where the one with mass is
        Particle newcomer = test::ball(1, 3, 2, 7).front();
        newcomer.id = 100 + std::uint64_t(mass);
        newcomer.mass = mass;
        insert_member(store, slot, newcomer, age);
        expected.push_back(newcomer);
        const Deviation moved = deviation(test::members(store, slot, age), expected);
        EXPECT_LE(moved.position, 4 * float_rounding * 5 * magnification(slot)) << "mass " << mass;
        EXPECT_LE(moved.velocity, 4 * float_rounding * 5 * magnification(slot)) << "mass " << mass;
    }
}

TEST_P(FormingByMap, InsertionKeepsTheSofteningTheMeanOfTheKinds)
{
    ParticleSet particles = test::ball(3, 1, 1, 1);
    const ClusterSlot slot = aged_cluster(particles, 1);
    Particle newcomer = particles.front();
    newcomer.id = 9;
    newcomer.kind = 2;
    newcomer.mass = 2;
    insert_member(store, slot, newcomer, age);
    EXPECT_FLOAT_EQ(store.clusters.softening_squared[slot.index], (3 * 0.01F + 2 * 0.16F) / 5);
}

TEST_P(FormingByMap, NoMemberIsBeyondTheBoundingRadius)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        ParticleSet particles = test::ball(30, 2, 1, seed, {5, -3, 8});
        test::give_masses(particles, 0.01, 3, seed);
        const ClusterSlot slot = aged_cluster(particles, 1);
        Particle newcomer = test::ball(1, 6, 2, seed, store.clusters.position[slot.index]).front();
        newcomer.id = 1000;
        insert_member(store, slot, newcomer, age);
        double farthest = 0;
        for (const Particle& member : test::members(store, slot, age))
            farthest = std::max(farthest, (member.position - store.clusters.position[slot.index]).norm());
        const double bound = bounding_radius(store.clusters, rule, slot.index, age);
        EXPECT_LE(farthest, bound) << "seed " << seed;
        EXPECT_GE(10 * farthest, bound) << "a bound that says something; seed " << seed;
    }
}

// A table of drifts stands for exponentials, each right to 4e-16.
TEST_P(FormingByMap, BothBoundsAtOnceAreThoseByThemselves)
{
    const ClusterSlot slot = aged_cluster(test::ball(30, 2, 1, 3, {5, -3, 8}), 0);
    const MemberBounds bounds = member_bounds(store, slot.index, age);
    const double radius = bounding_radius(store.clusters, rule, slot.index, age);
    const double velocity = velocity_bound(store.clusters, rule, slot.index, age);
    EXPECT_NEAR(bounds.radius, radius, 1e-14 * radius);
    EXPECT_NEAR(bounds.velocity, velocity, 1e-14 * velocity);
}

TEST(TakesMembers, NeedsAFreeRow)
{
    ClusterStore store = test::empty_store(identity);
    const ClusterSlot full = test::form(store, test::ball(8, 1, 1, 1));
    const ClusterSlot spacious = test::form(store, test::ball(8, 1, 1, 1), 0, 1);
    EXPECT_FALSE(takes_members(store, full, 5));
    EXPECT_TRUE(takes_members(store, spacious, 5));
    insert_member(store, spacious, {.position = {0, 0, 0}, .velocity = {0, 0, 0}, .id = 50, .mass = 1}, 5);
    EXPECT_FALSE(takes_members(store, spacious, 5));
}

// Under drag, velocities at forming are exp(k t) times those of now: beyond exp(k t) = 16 their rounding
// would be felt, and at exp(k t) > 1e308 they are not even numbers.
TEST(TakesMembers, EndsBeforeDragMakesTheInverseInexact)
{
    const MapRule rule{MapKind::Scalar, 1.0, 0.01};
    ClusterStore store = test::empty_store(rule);
    const ClusterSlot slot = test::form(store, test::ball(8, 1, 1, 1), 0, 1);
    EXPECT_TRUE(takes_members(store, slot, 277)); // exp(-2.77) > 1/16
    EXPECT_FALSE(takes_members(store, slot, 278));
    EXPECT_FALSE(takes_members(store, slot, 1'000'000));
}

} // namespace
} // namespace slod
