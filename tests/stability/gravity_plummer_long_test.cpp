#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/small_scenes.hpp"
#include "support/stellar_systems.hpp"
#include "support/totals.hpp"

// A hundred crossing times of a star cluster: what its own dynamics, the walk of the tree and the clusters do
// to it. Minutes each.
namespace slod::test {
namespace {

constexpr double softening = 0.05;
constexpr int looks = 50;

SystemHistory hundred_crossings(const std::string& name, const ParticleSet& start,
                                const SimulationSettings& settings)
{
    Simulation simulation(settings, start, {});
    SystemHistory history{name, {0}, {measure_system(start, softening)}};
    const int steps = int(std::ceil(100 * crossing_time / settings.time.step));
    for (int look = 1; look <= looks; ++look) {
        for (int step = steps * (look - 1) / looks; step < steps * look / looks; ++step)
            simulation.step({});
        history.times.push_back(double(steps * look / looks) * settings.time.step);
        history.looks.push_back(measure_system(simulation.particles(), softening));
    }
    return history;
}

/// A step of 1/64: with the core's frequency of 2.2, an error of the energy of (2.2 / 64)^2 / 24 = 5e-5 for
/// one star, and of all together a tenth of that.
SimulationSettings settings_of(double max_cluster_size, Motion motion)
{
    SimulationSettings settings = quiet_settings();
    settings.kinds.front().softening = softening;
    settings.gravity.emplace();
    settings.background.max_cluster_size = max_cluster_size;
    settings.motion.motion = motion;
    return settings;
}

void expect_balance(const SystemHistory& history)
{
    for (const SystemMeasures& look : history.looks)
        expect_within("2 K / |W|", look.virial_ratio, 0.95, 1.05);
}

// The relaxation time is 0.1 N / ln N = 108 crossing times.
TEST(LongPlummerSphere, G10_OfTenThousandStarsKeepsItsRadiiForAHundredCrossings)
{
    SimulationSettings settings = settings_of(1, Motion::Flow);
    settings.gravity->direct_below = 0;
    const SystemHistory history =
        hundred_crossings("single stars", plummer_in_equilibrium(10'000, 1), settings);
    expect_at_most("largest error of the energy", history.largest_change(&SystemMeasures::energy), 1e-3);
    expect_at_most("largest change of r10", history.largest_change(&SystemMeasures::r10), 0.15);
    expect_at_most("largest change of r50", history.largest_change(&SystemMeasures::r50), 0.05);
    expect_at_most("largest change of r90", history.largest_change(&SystemMeasures::r90), 0.2);
    expect_balance(history);
    report_history("Plummer sphere of 10,000 stars", std::array{history});
}

// As long with all pairs summed, of fewer stars: these are relaxed after 26 crossing times, so that only
// energy and balance are held.
TEST(LongPlummerSphere, G10_OfTwoThousandStarsKeepsItsEnergyWhereAllPairsAreSummed)
{
    SimulationSettings settings = settings_of(1, Motion::Flow);
    settings.gravity->direct_below = 1'000'000;
    const SystemHistory history = hundred_crossings("all pairs", plummer_in_equilibrium(2'000, 2), settings);
    expect_at_most("largest error of the energy", history.largest_change(&SystemMeasures::energy), 1e-4);
    expect_balance(history);
    report_history("Plummer sphere of 2,000 stars, all pairs", std::array{history});
}

class LongClusteredPlummerSphere : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(InClustersOf, LongClusteredPlummerSphere, testing::Values(8, 16),
                         testing::PrintToStringParamName());

// Stars that share a cluster do not meet each other as they would, and clusters are formed anew: that changes
// the energy without end, by what the noise of their forces heats less what the middle of a life takes. What
// is held is 5 % of r50 after the whole run, the relaxation time, as of single stars, and a fifth of what
// rigid motion does.
TEST_P(LongClusteredPlummerSphere, G10_InFlowKeepsItsRadiusForAHundredCrossingsWhereRigidMotionLosesIt)
{
    const ParticleSet start = plummer_in_equilibrium(10'000, 1);
    std::vector<SystemHistory> histories;
    std::vector<double> changes;
    for (const Motion motion : {Motion::Flow, Motion::Rigid}) {
        const std::string name(names(motion)[std::size_t(motion)]);
        histories.push_back(hundred_crossings(name, start, settings_of(GetParam(), motion)));
        const SystemHistory& history = histories.back();
        report_value("change of r10, " + name, history.change_at_the_end(&SystemMeasures::r10));
        report_value("change of r50, " + name, history.change_at_the_end(&SystemMeasures::r50));
        report_value("change of r90, " + name, history.change_at_the_end(&SystemMeasures::r90));
        report_value("change of the energy, " + name, history.change_at_the_end(&SystemMeasures::energy));
        changes.push_back(std::abs(history.change_at_the_end(&SystemMeasures::r50)));
        SystemHistory early = history;
        early.looks.resize(1 + looks / 10);
        report_value("change of the energy in ten crossings, " + name,
                     early.change_at_the_end(&SystemMeasures::energy));
    }
    expect_at_most("change of r50 in a hundred crossings in flow", changes[0], 0.05);
    expect_at_most("the same, of that in rigid motion", changes[0] / changes[1], 0.2);
    report_history("Plummer sphere of 10,000 stars in clusters of " + std::to_string(GetParam()), histories);
}

// Ten thousand stars turn for a thousand steps, by walks of the tree.
TEST(LongMomentum, G33_OfTenThousandStarsIsKeptForAThousandSteps)
{
    SimulationSettings settings = settings_of(1, Motion::Flow);
    settings.gravity->direct_below = 0;
    ParticleSet start = plummer_in_equilibrium(10'000, 3);
    double momentum_size = 0;
    for (Particle& particle : start) {
        particle.velocity += 0.3 * Vector3d(-particle.position.y(), particle.position.x(), 0);
        momentum_size += double(particle.mass) * particle.velocity.norm();
    }
    const ConservedQuantities before = totals(start);
    Simulation simulation(settings, start, {});
    for (int step = 0; step < 1000; ++step)
        simulation.step({});
    const ConservedQuantities after = totals(simulation.particles());
    expect_at_most("change of the momentum, of sum m |v|",
                   (after.momentum - before.momentum).norm() / momentum_size, 1e-3);
    expect_at_most("relative change of the angular momentum",
                   (after.angular_momentum - before.angular_momentum).norm() / before.angular_momentum.norm(),
                   1e-3);
}

} // namespace
} // namespace slod::test
