#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/merging_pairs.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"
#include "tree/merge_rules.hpp"

// O'Brien, Fisher, Lin 2001, section 6.2: what a merge changes at most, and what it all adds up to.
namespace slod::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// How far two clouds of equally many particles differ as a whole: the mean distance by which the particles
/// of one have to be moved along an axis to look like the other, whoever is who, averaged over the axes.
double difference(const ParticleSet& a, const ParticleSet& b)
{
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::array<std::vector<double>, 2> sorted;
        for (const Particle& particle : a)
            sorted[0].push_back(particle.position[axis]);
        for (const Particle& particle : b)
            sorted[1].push_back(particle.position[axis]);
        for (std::vector<double>& each : sorted)
            std::sort(each.begin(), each.end());
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += std::abs(sorted[0][i] - sorted[1].at(i)) / double(3 * a.size());
    }
    return sum;
}

ParticleSet fountain(double max_cluster_size, std::uint64_t seed)
{
    SimulationSettings settings = rigid_settings(max_cluster_size);
    settings.seed = seed;
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -4}};
    settings.linear_drag = LinearDragSettings{0.2};
    settings.emitters = {jet("jet")};
    settings.emitters[0].lifetime = 1;
    settings.regions = {ball_region("spring", {0, 0, 0}, 1, 1)};
    Simulation simulation(settings, {}, {});
    run(simulation, 100);
    return simulation.particles();
}

// What another seed changes is what nobody would notice.
TEST(Paper, A69_TheWholeLooksTheSameThoughEachParticleDiffers)
{
    constexpr std::uint64_t seeds = 8;
    double clustered = 0, reseeded = 0, astray = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const ParticleSet exact = fountain(1, seed), simplified = fountain(4, seed);
        clustered += difference(simplified, exact) / seeds;
        reseeded += difference(fountain(1, seed + seeds), exact) / seeds;
        astray += rms_distance(simplified, exact) / seeds;
    }
    EXPECT_LE(clustered, reseeded);
    EXPECT_GT(astray, 3 * reseeded);
}

// The formula is share * s (lambda - 1), with the partner's share of the mass.
TEST(Paper, A70_ThePapersChangeOfSpeedIsExactForParallelVelocities)
{
    for (const double ratio : {1.1, 2.0, 4.0}) {
        for (const double other_mass : {0.5, 1.0, 8.0}) {
            const double margin = 1 - 1e-15; // just within the limit
            std::vector<MergingPair> pair(1);
            pair[0].other_mass = other_mass;
            pair[0].velocity = {3, 0, 0};
            pair[0].other_velocity = {3 * ratio * margin, 0, 0};
            const RegionSettings limits{.speed_ratio = ratio, .angle_deg = 0.001};
            merge_pairs(pair, limits);
            ASSERT_TRUE(pair[0].merged);
            const double formula = other_mass / (1 + other_mass) * 3 * (ratio - 1);
            EXPECT_NEAR(pair[0].merged_velocity.x() - 3, formula, 1e-12);
        }
    }
    // But of equal speeds, where it gives 0, each loses 1 - cos(t / 2) when they are an angle t apart.
    std::vector<MergingPair> turned(1);
    turned[0].velocity = {1, 0, 0};
    turned[0].other_velocity = {std::cos(80 * degree), std::sin(80 * degree), 0};
    merge_pairs(turned, {.speed_ratio = 1 + 1e-9, .angle_deg = 90});
    ASSERT_TRUE(turned[0].merged);
    EXPECT_NEAR(1 - turned[0].merged_velocity.norm(), 1 - std::cos(40 * degree), 1e-12);
}

TEST(Paper, A71_ThePapersChangeOfDirectionIsExactForEqualMomenta)
{
    for (const double angle : {10.0, 45.0, 85.0}) {
        for (const double momentum_ratio : {1.0, 0.2, 5.0}) {
            std::vector<MergingPair> pair(1);
            pair[0].other_mass = double(float(momentum_ratio));
            pair[0].velocity = {1, 0, 0};
            pair[0].other_velocity = {std::cos(angle * degree), std::sin(angle * degree), 0};
            merge_pairs(pair, {.speed_ratio = 1 + 1e-9, .angle_deg = 90});
            ASSERT_TRUE(pair[0].merged);
            const Vector3d& v = pair[0].merged_velocity;
            const double turn = std::atan2(v.y(), v.x());
            const double r = pair[0].other_mass; // of momenta, as the speeds are equal
            EXPECT_NEAR(turn, std::atan2(r * std::sin(angle * degree), 1 + r * std::cos(angle * degree)),
                        1e-12);
            if (momentum_ratio == 1) {
                EXPECT_NEAR(turn, 0.5 * angle * degree, 1e-12);
            }
        }
    }
}

TEST(Paper, A72_TheDeviationGrowsWithThePartnersMass)
{
    const RegionSettings limits{.speed_ratio = 2, .angle_deg = 40};
    double deviation = 0, bound = 0;
    for (const double other_mass : {0.125, 0.5, 1.0, 4.0, 1024.0}) {
        std::vector<MergingPair> pair(1);
        pair[0].other_mass = other_mass;
        pair[0].velocity = {1, 0, 0};
        pair[0].other_velocity = {1.5, 0.5, 0};
        merge_pairs(pair, limits);
        ASSERT_TRUE(pair[0].merged);
        const double now = (pair[0].merged_velocity - pair[0].velocity).norm();
        EXPECT_GT(now, deviation);
        EXPECT_GT(velocity_change_bound(limits, 1, 1, other_mass), bound);
        EXPECT_LE(now, velocity_change_bound(limits, 1, 1, other_mass));
        deviation = now;
        bound = velocity_change_bound(limits, 1, 1, other_mass);
    }
}

// What the limits allow each merge to change, added up, is a budget that no particle exceeds: its cluster's
// velocity differs by no more from that of the particle alone, which here is the one it began with.
TEST(Paper, A73_TheChangesAllowedToEachMergeAddUpToABoundForAll)
{
    const RegionSettings limits{.max_cluster_size = 32,
                                .speed_ratio = 1.5,
                                .angle_deg = 30,
                                .velocity_reference = VelocityReference::Rest};
    ParticleSet particles = ball(1000, 2, 0.15, 1);
    give_masses(particles, 0.1, 10, 1);
    for (Particle& particle : particles)
        particle.velocity.x() += 1;
    RigidWorld world({.background = limits, .regions = {}}, particles, true);
    std::vector<double> budget(particles.size(), 0), mass(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i)
        mass[i] = double(particles[i].mass);
    std::vector<Vector3d> velocity(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i)
        velocity[i] = particles[i].velocity;
    double closest = 0;
    for (int frame = 0; frame < 128; ++frame) {
        world.advance();
        const std::vector<ClusterSlot> clusters = world.cluster_of_particles();
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const std::size_t slot = clusters[i].index;
            const double now = world.clusters().mass(slot);
            if (now > mass[i])
                budget[i] += velocity_change_bound(limits, velocity[i].norm(), mass[i], now - mass[i]);
            velocity[i] = world.clusters().velocity[slot];
            mass[i] = now;
            const double deviation = (velocity[i] - particles[i].velocity).norm();
            ASSERT_LE(deviation, budget[i] + 1e-12) << "particle " << i << " in frame " << world.frame;
            closest = std::max(closest, budget[i] > 0 ? deviation / budget[i] : 0);
        }
    }
    EXPECT_GT(closest, 0.2) << "or the bound says little";
}

TEST(Paper, A74_EveryFrameKeepsItsInvariants)
{
    for (const SmallScene& scene : small_scenes()) {
        SCOPED_TRACE(scene.name);
        Simulation simulation(scene.settings, scene.initial, {});
        for (int frame = 0; frame < 24; ++frame) {
            const Snapshot& snapshot = simulation.step({});
            ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
            std::uint64_t held = 0;
            for (const RegionLoad& load : snapshot.regions)
                held += load.particles;
            ASSERT_EQ(held, snapshot.counts.particles) << "frame " << frame;
        }
    }
}

} // namespace
} // namespace slod::test
