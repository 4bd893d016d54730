#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/attracting_world.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/leapfrog.hpp"
#include "support/small_scenes.hpp"

// Pairs within their softening, pairs in one cluster, and clusters without mass.
namespace slod::test {
namespace {

/// Both motions of clusters that self-gravity has a use for.
class ClusterMotion : public testing::TestWithParam<Motion> {
protected:
    static SimulationSettings settings()
    {
        SimulationSettings settings = quiet_settings();
        settings.gravity.emplace();
        settings.gravity->precision = Precision::Double;
        settings.motion.motion = GetParam();
        settings.background.max_cluster_size = 64;
        return settings;
    }
};

INSTANTIATE_TEST_SUITE_P(In, ClusterMotion, testing::Values(Motion::Flow, Motion::Rigid),
                         [](const auto& tested) {
                             return std::string(names(tested.param)[std::size_t(tested.param)]);
                         });

/// A heavy pair on a circular orbit.
ParticleSet heavy_pair()
{
    return {{{1, 0, 0}, {0, 0.5, 0}, 0, 1}, {{-1, 0, 0}, {0, -0.5, 0}, 1, 1}};
}

// Bins keep the tracers in clusters of their own. The pair is moved by one pull each; where the bodies'
// order has changed, relative to another origin, which rounds places by 1e-16 a step.
TEST_P(ClusterMotion, G23_TracersInClustersDoNotAct)
{
    constexpr int frames = 400;
    SimulationSettings with_bins = settings();
    with_bins.background.bin_by = BinBy::Mass;
    with_bins.background.bin_floor = 0.5;
    const auto run = [&](const ParticleSet& initial) {
        Simulation simulation(with_bins, initial, {});
        for (int frame = 0; frame < frames; ++frame)
            simulation.step({});
        return simulation.particles();
    };
    ParticleSet with_tracers = heavy_pair();
    add_cloud(with_tracers, {.count = 640, .scale = 2}, 6);
    for (Particle& particle : with_tracers)
        particle.mass = particle.id < 2 ? 1 : 0;
    ParticleSet moved = run(with_tracers);
    bool finite = true;
    for (const Particle& particle : moved)
        finite = finite && particle.position.allFinite() && particle.velocity.allFinite();
    expect_at_least("tracers that are finite", finite ? 640 : 0, 640);
    moved.resize(2);
    expect_at_most("distance of the heavy ones from where they are without tracers",
                   largest_distance(moved, run(heavy_pair())), frames * frames * 0x1p-53);
}

// Two particles in one cell are one cluster, whose centre nothing pulls. Its members attract each other in
// flow and do not move in rigid motion, so that neither leaves the other faster than by itself. Places at 512
// are rounded by 2^-44 a frame.
TEST_P(ClusterMotion, G26_TwoParticlesAreOneClusterThatMovesStraightOn)
{
    constexpr int frames = 400;
    SimulationSettings one_cell = settings();
    one_cell.background.max_breadth = 1024;
    const float mass = 0x1p-7F; // light enough for a step of 1/64 to resolve how they fall past each other
    const Vector3d middle(512, 512, 512), drift(0.5, 0, 0);
    const ParticleSet pair{{middle + Vector3d(0.125, 0, 0), drift + Vector3d(0, 0.125, 0), 0, mass},
                           {middle - Vector3d(0.125, 0, 0), drift - Vector3d(0, 0.125, 0), 1, mass}};
    Simulation simulation(one_cell, pair, {});
    std::size_t clusters = 0;
    for (int frame = 0; frame < frames; ++frame)
        clusters = std::max<std::size_t>(clusters, simulation.step({}).counts.clusters);
    const ParticleSet particles = simulation.particles();
    const double time = frames * one_cell.time.step;
    const Vector3d centre = 0.5 * (particles[0].position + particles[1].position);
    expect_within("particles", double(particles.size()), 2, 2);
    expect_within("most clusters", double(clusters), 1, 1);
    expect_at_most("distance of their centre from the straight line", (centre - middle - time * drift).norm(),
                   frames * 0x1p-44);
    expect_at_most("distance between them", (particles[0].position - particles[1].position).norm(),
                   0.25 + 0.25 * time);
    EXPECT_EQ(simulation.problems(), Problems{});
}

class SoftPair : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, SoftPair, testing::Values(Precision::Mixed, Precision::Double),
                         [](const auto& tested) {
                             return std::string(names(tested.param)[std::size_t(tested.param)]);
                         });

// Plummer's pull, m r / (r^2 + eps^2)^(3/2), is a spring's within a part in a million at a thousandth of eps.
TEST_P(SoftPair, G34_WithinItsSofteningPullsAsASpring)
{
    constexpr double eps = 0.05;
    double formula = 0, spring = 0, tide = 0;
    CaseCurve curve{"pull", {}, {}};
    for (double share = 1e-6; share < 2; share *= 10) {
        const double distance = share * eps;
        ParticleSet pair = cloud(2, 1, [](Random&) { return Vector3d(0, 0, 0); });
        pair[1].position = distance * Vector3d(2, -1, 2) / 3;
        for (Particle& particle : pair)
            particle.mass = 1;
        AttractingWorld world(pair, eps);
        world.settings.precision = GetParam();
        world.evaluate();
        const double expected = distance / std::pow(distance * distance + eps * eps, 1.5);
        for (const Vector3d& pull : world.by_id())
            formula = worse(formula, std::abs(pull.norm() / expected - 1));
        if (share < 1e-3) {
            spring = worse(spring, std::abs(world.by_id()[0].norm() * std::pow(eps, 3) / distance - 1));
            tide = worse(tide, (world.tide(0) * std::pow(eps, 3) + Matrix3d::Identity()).norm());
        }
        curve.x.push_back(share);
        curve.y.push_back(world.by_id()[0].norm());
    }
    expect_at_most("largest error of a pull, from 1e-6 to 1 softening length", formula, 1e-6);
    expect_at_most("largest error of a spring's pull, below 1e-3", spring, 1e-6);
    expect_at_most("largest error of a spring's tide, below 1e-3", tide, 1e-6);
    report_picture(
        {"Two bodies of mass 1, softening 0.05", "distance, softening lengths", "pull", {curve}, true, true});
}

} // namespace
} // namespace slod::test
