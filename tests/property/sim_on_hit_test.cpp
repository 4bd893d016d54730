#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "effects/colliders.hpp"
#include "sim/simulation.hpp"
#include "support/clouds.hpp"
#include "support/meshes.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// Colliders that hold for good what meets them, and colliders that end it.
namespace slod::test {
namespace {

constexpr double frame = 1.0 / 60;

ColliderSettings doing(OnHit on_hit, ColliderSettings collider)
{
    collider.on_hit = on_hit;
    return collider;
}

TEST(StickyCollider, HoldsAParticleWhereItMetAndCarriesItAlong)
{
    ColliderSettings wall = doing(OnHit::Stick, plane({0, 0, 0}, {-1, 0, 0}));
    wall.velocity = {-3, 0.5, 0};
    UniformFields fields;
    fields.gravity = {-40, 0, -9.81}; // away from it and along it
    Colliders colliders({wall}, fields, frame);
    Vector3d position(-0.2, 0, 0), velocity(60, 0, 1);
    const auto met = colliders.fly(position, velocity, frame);
    EXPECT_EQ(met.impacts, 1U);
    EXPECT_TRUE(met.touched);
    EXPECT_EQ(velocity, wall.velocity);
    EXPECT_NEAR(position.x(), -3 * frame, 1e-15);
    const Vector3d there = position - frame * wall.velocity;
    for (int i = 2; i <= 1000; ++i) {
        colliders.set_frame_end(i * frame);
        const auto held = colliders.fly(position, velocity, frame);
        ASSERT_EQ(held.impacts, 0U);
        ASSERT_EQ(velocity, wall.velocity);
    }
    // A thousand steps of half a tenth, each rounded by half an ulp of at most 50.
    EXPECT_LE((position - 1000 * frame * wall.velocity - there).norm(), 1000 * 50 * 0x1p-53);
}

TEST(KillingCollider, EndsAFlightWhereItMet)
{
    for (const ColliderSettings& shape : {plane({0, 0, 0}, {0, 0, 1}), sheet(flat_mesh(5, 5, 1), 0.5)}) {
        const Colliders colliders({doing(OnHit::Kill, shape)}, {}, frame);
        Vector3d position(2.2, 2.1, 1), velocity(0, 0, -120);
        const auto met = colliders.fly(position, velocity, frame);
        EXPECT_TRUE(met.killed);
        EXPECT_EQ(met.impacts, 1U);
        EXPECT_NEAR(position.z(), shape.shape == ColliderShape::Plane ? 0 : 0.25, 1e-15);
        position = {2.2, 2.1, 1};
        velocity = {0, 0, 120};
        EXPECT_FALSE(colliders.fly(position, velocity, frame).killed);
    }
}

class OnHitOfClusters : public testing::TestWithParam<Motion> {
protected:
    static SimulationSettings settings(const ColliderSettings& collider)
    {
        SimulationSettings settings = quiet_settings();
        settings.motion.motion = GetParam();
        settings.background.max_cluster_size = 64;
        settings.background.max_breadth = 2;
        settings.uniform_gravity.emplace();
        settings.colliders = {collider};
        return settings;
    }
};

// A ceiling, from which each would fall that came loose.
TEST_P(OnHitOfClusters, StickyOnesKeepAllMembersForGood)
{
    for (const Vector3d& motion : {Vector3d(0, 0, 0), Vector3d(0.5, 0, -0.25)}) {
        ColliderSettings ceiling = doing(OnHit::Stick, plane({0, 0, 3}, {0, 0, -1}));
        ceiling.velocity = motion;
        ParticleSet initial = ball(300, 0.4, 0.5, 1, {1.3, 0.7, 2});
        for (Particle& particle : initial)
            particle.velocity.z() += 12;
        Simulation simulation(settings(ceiling), initial, {});
        std::uint64_t impacts = 0;
        for (int i = 0; i < 600; ++i)
            impacts += simulation.step({}).counts.impacts;
        EXPECT_EQ(impacts, initial.size());
        EXPECT_EQ(simulation.problems(), Problems{});
        const double height = 3 + motion.z() * 600 * settings(ceiling).time.step;
        for (const Particle& particle : simulation.particles()) {
            // Offsets below 2, and velocities' below 1 of a step, rounded to float.
            EXPECT_NEAR(particle.position.z(), height, 2 * 0x1p-24);
            EXPECT_LE((particle.velocity - motion).norm(), 1e-6);
        }
    }
}

TEST_P(OnHitOfClusters, KillingOnesLeaveOutWhoMeetsThemAndCountThem)
{
    SimulationSettings scene = settings(doing(OnHit::Kill, sphere({0, 0, 0}, 0.5)));
    scene.emitters = {jet("close")};
    scene.emitters[0].position = {0, 0, 0.6};
    scene.emitters[0].cone_angle_deg = 180;
    const ParticleSet initial = ball(500, 1, 0.5, 4, {0, 0, 2});
    Simulation simulation(scene, initial, {});
    std::uint64_t alive = initial.size(), killed = 0;
    for (int i = 0; i < 200; ++i) {
        const FrameCounts& counts = simulation.step({}).counts;
        ASSERT_LE(counts.killed, counts.died);
        ASSERT_EQ(counts.killed, counts.impacts);
        alive += counts.born - counts.died;
        killed += counts.killed;
        ASSERT_EQ(counts.particles, alive) << "frame " << i;
        ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << i;
    }
    EXPECT_GT(killed, 100U);
    EXPECT_GT(alive, 100U);
    for (const Particle& particle : simulation.particles())
        EXPECT_GT(particle.position.norm(), 0.5 - 1e-6); // places are rounded to float
}

// Without forces a particle keeps its momentum until it is struck.
TEST_P(OnHitOfClusters, WhatTheKilledHadAndWhatIsLeftIsWhatThereWas)
{
    SimulationSettings scene = settings(doing(OnHit::Kill, sphere({0, 0, 0}, 0.5)));
    scene.uniform_gravity.reset();
    ParticleSet initial = ball(500, 1, 0.5, 4, {0, 0, 2});
    for (Particle& particle : initial) {
        particle.mass = float(1 + particle.id % 3);
        particle.velocity.z() -= 4;
    }
    Simulation simulation(scene, initial, {});
    ConservedQuantities before = simulation.step({.conserved = true}).conserved;
    // 500 masses are summed up twice, each time rounded by 2^-53 of all of them, below 1,000; at speeds
    // below 8.
    constexpr double mass_rounding = 1000 * 0x1p-53 * 1000, speed = 8;
    double killed = 0;
    for (int i = 0; i < 100; ++i) {
        const Snapshot& now = simulation.step({.conserved = true});
        EXPECT_EQ(now.killed.particles, now.counts.killed);
        ASSERT_NEAR(now.conserved.mass + now.killed.mass, before.mass, mass_rounding) << "frame " << i;
        ASSERT_LE((now.conserved.momentum + now.killed.momentum - before.momentum).norm(),
                  speed * mass_rounding)
            << "frame " << i;
        before = now.conserved;
        killed += now.killed.mass;
    }
    EXPECT_GT(killed, 100);
}

INSTANTIATE_TEST_SUITE_P(Motions, OnHitOfClusters,
                         testing::Values(Motion::Flow, Motion::Stream, Motion::Rigid));

} // namespace
} // namespace slod::test
