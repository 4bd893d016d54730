#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/leapfrog.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"
#include "support/totals.hpp"

// O'Brien, Fisher, Lin 2001, section 4.4: a cluster moves as the particle at its centre of mass.
namespace slod::test {
namespace {

using Wide = Eigen::Matrix<long double, 3, 1>;

/// Weighted means of position and velocity, of number when `massless`.
std::pair<Vector3d, Vector3d> centre_of(const ParticleSet& particles, bool massless)
{
    long double total = 0;
    Wide position = Wide::Zero(), velocity = Wide::Zero();
    for (const Particle& particle : particles) {
        const long double weight = massless ? 1.0L : static_cast<long double>(particle.mass);
        total += weight;
        position += weight * particle.position.cast<long double>();
        velocity += weight * particle.velocity.cast<long double>();
    }
    return {(position / total).cast<double>(), (velocity / total).cast<double>()};
}

TEST(Paper, A39_TheCentreIsTheMassWeightedMeanAndMomentumSurvivesEveryMergeAndSplit)
{
    for (const double heaviest : {0.0, 1.0, 1e6}) {
        ParticleSet particles = ball(50, 1, 3, 1, {100, 20, -5});
        give_masses(particles, 0, heaviest, 1);
        ClusterStore store = empty_store({MapKind::Identity, 0, 1});
        const ClusterSlot slot = form(store, particles);
        const auto [position, velocity] = centre_of(particles, heaviest == 0);
        EXPECT_LE((store.clusters.position[slot.index] - position).norm(), 1e-12 * position.norm());
        EXPECT_LE((store.clusters.velocity[slot.index] - velocity).norm(), 1e-12 * velocity.norm());
    }
    ParticleSet particles = ball(1000, 2, 1, 2);
    give_masses(particles, 0.1, 10, 2);
    RigidRules rules{.background = {.max_cluster_size = 16, .max_breadth = 1}, .regions = {}};
    rules.background.speed_ratio = 100;
    rules.background.angle_deg = 180;
    RigidWorld world(rules, particles);
    const auto momentum = [&] { return conserved_quantities(world.store(), world.frame).momentum; };
    const Vector3d before = momentum();
    std::uint64_t merges = 0, splits = 0;
    for (int frame = 0; frame < 200; ++frame) {
        world.advance();
        merges += world.counts.merges;
        splits += world.counts.splits;
    }
    EXPECT_GT(merges, 50U);
    EXPECT_GT(splits, 50U);
    EXPECT_LE((momentum() - before).norm(), 1e-12 * 5000) << "relative to the sum of all momenta's sizes";
}

const Vector3d middle(512, 512, 512); ///< of a cell of side 1024

TEST(Paper, A40_AClustersCentreFollowsTheMeanOfItsMembersOwnPaths)
{
    ParticleSet particles = ball(40, 1, 3, 1, middle);
    give_masses(particles, 0.5, 2, 1);
    Simulation together(windy(64), particles, {}), apart(windy(1), particles, {});
    for (int frame = 0; frame < 200; ++frame) {
        const Snapshot& snapshot = together.step({.clusters = true});
        ASSERT_EQ(snapshot.clusters.size(), 1U);
        apart.step({});
        const auto [position, velocity] = centre_of(apart.particles(), false);
        ASSERT_LE((snapshot.clusters.position[0] - position).norm(), 1e-9 * (1 + position.norm()));
        ASSERT_LE((snapshot.clusters.velocity[0] - velocity).norm(), 1e-9 * (1 + velocity.norm()));
    }
    // Drag per unit mass is the members' own: n of them fall as fast as one, by g / k beside the wind. What
    // is left of the start after 60 decay times is below any rounding.
    run(together, 64 * 120 - 200);
    const Vector3d terminal(2, -1, -9.81 / 0.5);
    EXPECT_LE((together.snapshot({.clusters = true}).clusters.velocity[0] - terminal).norm(), 1e-12 * 20);
}

// An offset is added to the centre's position, before and after: four roundings of half a unit each at most,
// and in positions below 1024 a unit is 2^-43.
TEST(Paper, A41_AllMembersAreDisplacedAlikeAndKeepTheirOwnVelocities)
{
    const ParticleSet particles = ball(40, 1, 0.01, 1, middle);
    Simulation simulation(windy(64), particles, {});
    const ParticleSet before = simulation.particles();
    run(simulation, 200);
    const ParticleSet after = simulation.particles();
    const Vector3d displacement = after[0].position - before[0].position;
    const Vector3d change = after[0].velocity - before[0].velocity;
    EXPECT_GT(displacement.norm(), 10);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        EXPECT_LE((after[i].position - before[i].position - displacement).cwiseAbs().maxCoeff(), 2 * 0x1p-43);
        EXPECT_LE((after[i].velocity - before[i].velocity - change).cwiseAbs().maxCoeff(), 2 * 0x1p-43);
        EXPECT_LE((before[i].velocity - particles[i].velocity).norm(), 0.02 * 0x1p-23) << "kept as a float";
    }
}

/// Displacements, rounded to 2^-30, of 64 particles in 20 frames: each by itself at first, merged in 100
/// frames, and each by itself again.
std::set<std::array<double, 3>> ways_after_merging(MergedVelocities merged_velocities, std::uint64_t& merged)
{
    SimulationSettings settings = rigid_settings(16);
    settings.motion.merged_velocities = merged_velocities;
    settings.background.speed_floor = 1;
    settings.regions = {world_region("single", 1)};
    Simulation simulation(settings, ball(64, 1, 0.5, 1), {});
    EXPECT_EQ(simulation.remove_region("single"), Problems{});
    merged = run(simulation, 100).counts.clusters;
    EXPECT_EQ(simulation.add_region(settings.regions[0]), Problems{});
    EXPECT_EQ(run(simulation, 9).counts.clusters, 64U) << "one to enter, eight to split";
    const ParticleSet before = simulation.particles();
    run(simulation, 20);
    const ParticleSet after = simulation.particles();
    std::set<std::array<double, 3>> ways;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Vector3d way = 0x1p30 * (after[i].position - before[i].position);
        ways.insert({std::round(way.x()), std::round(way.y()), std::round(way.z())});
    }
    return ways;
}

TEST(Paper, A41_WhereVelocitiesCollapseMembersOfAMergedClusterMoveAsOneEvenAfterTheyArePartedAgain)
{
    std::uint64_t merged = 0;
    EXPECT_EQ(ways_after_merging(MergedVelocities::Keep, merged).size(), 64U);
    EXPECT_EQ(ways_after_merging(MergedVelocities::Collapse, merged).size(), merged);
    EXPECT_LT(merged, 16U);
}

TEST(Paper, A42_AClusterAttractsAndIsAttractedAsOneBody)
{
    SimulationSettings settings = rigid_settings(16);
    settings.kinds[0].softening = 0.25; // with a square that is kept exactly
    settings.background.max_breadth = 1;
    settings.gravity.emplace();
    settings.gravity->precision = Precision::Double;
    ParticleSet particles = ball(8, 0, 0, 1, {0.5, 0.5, 0.5}); // in one place
    Particle single;
    single.position = {3.5, 0.5, 0.5};
    single.velocity = {0, 1, 0};
    single.mass = 0.5;
    single.id = 9;
    particles.push_back(single);
    Simulation simulation(settings, particles, {});
    EXPECT_EQ(run(simulation, 40).counts.interactions, 2U) << "one body on the other, and none on itself";
    Particle heavy = particles[0];
    heavy.mass = 8;
    const ParticleSet expected = leapfrog({heavy, single}, settings, 40);
    const ParticleSet found = simulation.particles();
    // Rounding in 40 frames of quantities of order 1.
    EXPECT_LE((found.back().position - expected.back().position).norm(), 40 * 0x1p-50);
    EXPECT_LE((found.front().position - expected.front().position).norm(), 40 * 0x1p-50);

    settings.background = windy(64).background;
    Simulation isolated(settings, ball(40, 1, 0.1, 1, middle), {});
    const Vector3d velocity = isolated.snapshot({.clusters = true}).clusters.velocity[0];
    EXPECT_EQ(run(isolated, 200).clusters.velocity[0], velocity);
}

RegionOfInterest sight(const std::string& name, double field_of_view, double max_cluster_size,
                       const Vector3d& direction)
{
    RegionOfInterest region = world_region(name, max_cluster_size);
    region.shape = Shape::Frustum;
    region.direction = direction;
    region.up = {0, 0, 1};
    region.field_of_view_deg = field_of_view;
    region.aspect = 1;
    return region;
}

TEST(Paper, A43_WhatTheViewerLooksAtIsFineTheRimLessAndTheRestCoarse)
{
    SimulationSettings settings = rigid_settings(64);
    settings.regions = {sight("centre", 20, 1, {1, 0, 0}), sight("periphery", 60, 8, {1, 0, 0})};
    settings.regions[0].precedence = 1;
    Simulation simulation(settings, cube(20'000, 4, 1), {});
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-0.6, 0.8, 0)}) {
        for (RegionOfInterest region : settings.regions) {
            region.direction = direction;
            ASSERT_EQ(simulation.change_region(region), Problems{});
        }
        const Snapshot& snapshot = run(simulation, 200);
        EXPECT_EQ(clusters_in_wrong_regions(simulation, snapshot), 0U);
        const RegionLoad centre = load_of(simulation, snapshot, "centre");
        EXPECT_GT(centre.particles, 50U);
        // Clusters that come in are split within eight frames: one of the rim's eight may have done so just
        // now.
        EXPECT_GE(centre.clusters + 7, centre.particles);
        const double rim = mean_size(load_of(simulation, snapshot, "periphery"));
        EXPECT_GE(rim, 4);
        EXPECT_LE(rim, 8);
        EXPECT_GE(mean_size(load_of(simulation, snapshot, "background")), 32);
    }
}

} // namespace
} // namespace slod::test
