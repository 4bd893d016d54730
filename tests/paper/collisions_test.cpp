#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/random_draws.hpp"
#include "support/rigid_scenes.hpp"
#include "support/solids.hpp"

// O'Brien, Fisher, Lin 2001, section 5.1: critical events, which a cluster is taken apart for.
namespace slod::test {
namespace {

SimulationSettings falling(double max_cluster_size, Motion motion)
{
    SimulationSettings settings = rigid_settings(max_cluster_size);
    settings.motion.motion = motion;
    settings.uniform_gravity.emplace();
    return settings;
}

/// A floor of bumps: balls side by side, nearly half as high as they are wide.
std::vector<ColliderSettings> bumpy_floor()
{
    std::vector<ColliderSettings> bumps;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            bumps.push_back(with(sphere({0.4 * x, 0.4 * y, -0.2}, 0.3), 0.8, 0));
    return bumps;
}

ParticleSet falling_ball(std::size_t count, std::uint64_t seed)
{
    ParticleSet particles = ball(count, 0.25, 0, seed, {0, 0, 2});
    for (Particle& particle : particles)
        particle.velocity = {0, 0, -3};
    return particles;
}

TEST(Paper, A44_AClusterIsTakenApartBeforeItMeetsAnUnevenSurfaceAndMergesAfterwards)
{
    SimulationSettings settings = falling(100, Motion::Rigid);
    settings.background.max_breadth = 8;
    settings.linear_drag = LinearDragSettings{1};                            // they fall alike in the end
    settings.colliders = {with(cone({4, 4, 0}, {0, 0, -0.4}, 0.4), 0.3, 0)}; // amid a cell of the grid
    ParticleSet initial = falling_ball(64, 1);
    for (Particle& particle : initial)
        particle.position += Vector3d(4, 4, 0);
    Simulation simulation(settings, initial, {});
    std::uint64_t impacts = 0, last = 0, most_before = 0;
    for (int frame = 0; frame < 400; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        // In a frame it falls less than 0.1, so nobody within its radius of 0.25 is near yet.
        if (simulation.particles().front().position.z() > 0.7) {
            EXPECT_EQ(counts.clusters, 1U) << "far from the cone, in frame " << frame;
        }
        if (impacts == 0)
            most_before = std::max(most_before, counts.clusters);
        impacts += counts.impacts;
        last = counts.clusters;
        ASSERT_EQ(simulation.problems(), Problems{});
    }
    EXPECT_EQ(most_before, 64U) << "each was alone before the first impact";
    EXPECT_GT(impacts, 32U);
    EXPECT_LE(last, 4U) << "16 to a cluster and more, when they have fallen for long";
}

/// Directions in which particles leave a bumpy floor, by the cosine of the angle to the vertical.
std::vector<double> scatter(double max_cluster_size, Motion motion, std::uint64_t seed)
{
    SimulationSettings settings = falling(max_cluster_size, motion);
    settings.colliders = bumpy_floor();
    Simulation simulation(settings, falling_ball(2048, seed), {});
    run(simulation, 40); // 0.6 of a unit of time: all have bounced once or twice, and spread
    std::vector<double> cosines;
    for (const Particle& particle : simulation.particles())
        cosines.push_back(particle.velocity.z() / particle.velocity.norm());
    std::sort(cosines.begin(), cosines.end());
    return cosines;
}

/// Largest distance between the distributions of two sorted samples of the same size.
double kolmogorov_smirnov(const std::vector<double>& a, const std::vector<double>& b)
{
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto below = std::upper_bound(b.begin(), b.end(), a[i]) - b.begin();
        largest = std::max(largest, std::abs(double(i + 1) - double(below)) / double(a.size()));
    }
    return largest;
}

TEST(Paper, A45_DirectionsAfterAnUnevenSurfaceAreDistributedAsWithoutClusters)
{
    const std::vector<double> alone = scatter(1, Motion::Rigid, 1);
    const double critical = 1.358 * std::sqrt(2.0 / double(alone.size())); // p = 0.05, two samples
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid})
        EXPECT_LT(kolmogorov_smirnov(scatter(64, motion, 2), alone), critical);
    EXPECT_GT(alone.back() - alone.front(), 1) << "the surface does scatter";
}

/// Half of each cluster is over the edge of a table: how many fall, of those that should.
void expect_fall(Motion motion)
{
    SimulationSettings settings = falling(64, motion);
    settings.colliders = {with(box({-5, 0, -0.5}, {5, 5, 0.5}), 0, 1)};
    const ParticleSet initial = falling_ball(1024, 3);
    Simulation simulation(settings, initial, {});
    std::set<std::uint64_t> over_the_edge, fallen;
    for (const Particle& particle : initial)
        if (particle.position.x() > 0)
            over_the_edge.insert(particle.id);
    std::uint64_t impacts = 0, taken_apart = 0;
    for (int frame = 0; frame < 120; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        taken_apart += counts.taken_apart;
        if (impacts == 0 && counts.impacts > 0) {
            EXPECT_GT(taken_apart, 0U) << "before the first contact";
        }
        impacts += counts.impacts;
    }
    for (const Particle& particle : simulation.particles())
        if (particle.position.z() < -1)
            fallen.insert(particle.id);
    expect_at_most("error of the share that falls",
                   std::abs(double(fallen.size()) - double(over_the_edge.size())) / 1024, 0.02);
    EXPECT_EQ(fallen, over_the_edge);
    EXPECT_EQ(impacts, 1024 - fallen.size());
}

TEST(Paper, S19_OfAClusterHalfOverACliffThatHalfFalls)
{
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid})
        expect_fall(motion);
}

} // namespace
} // namespace slod::test
