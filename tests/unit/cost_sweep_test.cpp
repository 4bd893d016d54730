#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "cost/drifts.hpp"
#include "cost/metrics.hpp"
#include "cost/sweep.hpp"
#include "support/small_scenes.hpp"

namespace slod::cost {
namespace {

const auto silent = [](const std::string&, double) {};

/// A clock that is read and moves on by a millisecond.
Clock ticking()
{
    return [now = 0.0]() mutable { return now += 1; };
}

SimulationSettings attracting()
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace();
    return scene;
}

/// Without any finished runs.
Sweep sweep_anew(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan)
{
    FinishedRuns none;
    return run_sweep(scene, initial, plan, ticking(), silent, none);
}

ParticleSet cloud(std::uint32_t count, std::uint64_t seed)
{
    ParticleSet particles;
    test::add_cloud(particles, {.count = count}, seed);
    return particles;
}

/// A cloud in its own gravity.
Sweep small_sweep(const SweepPlan& plan)
{
    return sweep_anew(
        attracting(), [](std::uint64_t seed) { return cloud(600, seed); }, plan);
}

const SweepPlan two_motions{
    .settings = {{Motion::Flow, 8}, {Motion::Rigid, 8}}, .frames = 60, .seeds = 3, .rounds = 0};

// The reference has a quarter of the step, and the cloud is chaotic: a fraction of what another seed changes
// is what the step does.
TEST(CostSweep, TheUnclusteredRunComesFirstAndIsNearTheReference)
{
    const Sweep sweep = small_sweep(two_motions);
    ASSERT_EQ(sweep.rows.size(), 3U);
    EXPECT_EQ(sweep.rows[0].setting.name(), "unclustered");
    EXPECT_LT(sweep.rows[0].errors.largest(), 1);
    EXPECT_GT(sweep.rows[0].errors.largest(), 0);
    EXPECT_EQ(sweep.rows[0].clusters, 600);
    EXPECT_FALSE(sweep.floor.resampled);
    EXPECT_GT(sweep.floor.position, 0);
    EXPECT_EQ(sweep.rows[0].particles, 600);
}

TEST(CostSweep, RigidClustersAreFartherOffThanThoseThatFlow)
{
    const Sweep sweep = small_sweep(two_motions);
    EXPECT_GT(sweep.rows[2].errors.largest(), sweep.rows[1].errors.largest());
    EXPECT_GT(sweep.rows[2].median_displacement, sweep.rows[1].median_displacement);
    EXPECT_LT(sweep.rows[1].clusters, 200);
}

// Below 3,000 clusters all pairs are summed, in float: 1e-7 by each pair, and by the worst of sums that
// cancel a thousand times that. Clusters of eight miss percents.
TEST(CostSweep, AccelerationsAreOffByWhatClustersMiss)
{
    const Sweep sweep = small_sweep(two_motions);
    EXPECT_LT(sweep.rows[0].force.max, 1e-4);
    EXPECT_GT(sweep.rows[1].force.median, 1e-3);
    EXPECT_LE(sweep.rows[1].force.median, sweep.rows[1].force.p90);
    EXPECT_LE(sweep.rows[1].force.p90, sweep.rows[1].force.p99);
    EXPECT_LE(sweep.rows[1].force.p99, sweep.rows[1].force.max);
}

TEST(CostSweep, WhatNothingAcceleratesOtherwiseThanExactlyHasNoError)
{
    SimulationSettings scene = test::quiet_settings();
    scene.uniform_gravity.emplace();
    const Sweep sweep = sweep_anew(scene, [](std::uint64_t seed) { return cloud(100, seed); },
                                   {.settings = {{Motion::Flow, 8}}, .frames = 10, .seeds = 1, .rounds = 0});
    EXPECT_EQ(sweep.rows[1].force.max, 0);
}

// All pairs are symmetric but for the rounding of floats, 6e-8 of each pull, so momenta drift by no more than
// that times some steps. Energy is kept to the order of (step / time of the closest pairs)^2, percents.
TEST(CostSweep, WhatAnIsolatedSystemConservesIsFollowed)
{
    const Sweep sweep = small_sweep(two_motions);
    const Row& row = sweep.rows[0];
    EXPECT_LT(row.drifts.momentum, 1e-5);
    EXPECT_LT(row.drifts.angular_momentum, 1e-5);
    EXPECT_GT(std::abs(row.drifts.energy), 0);
    EXPECT_LT(std::abs(row.drifts.energy), 0.05);
}

// m v of both, r x m v of the second alone, m v^2 / 2 of both, and -G m m / (d^2 + eps^2)^(1/2) with G = 1,
// which the scene's units have to 1e-15.
TEST(CostDrifts, TotalsOfTwoBodiesAreTheirFormulas)
{
    SimulationSettings scene = attracting();
    scene.kinds[0].softening = 1.5;
    const ParticleSet pair{{.position = {0, 0, 0}, .velocity = {1, 0, 0}, .id = 1, .mass = 2},
                           {.position = {2, 0, 0}, .velocity = {0, 3, 0}, .id = 2, .mass = 4}};
    const Totals sum = totals(pair, scene);
    EXPECT_EQ(sum.mass, 6);
    EXPECT_EQ(sum.momentum, Vector3d(2, 12, 0));
    EXPECT_EQ(sum.angular_momentum, Vector3d(0, 0, 24));
    EXPECT_EQ(sum.second_moment, 16);
    EXPECT_EQ(sum.kinetic_energy, 19);
    EXPECT_NEAR(sum.potential_energy, -8 / 2.5, 1e-14);
}

TEST(CostDrifts, AreSharesOfTheLargestThereCouldBe)
{
    Totals start, end;
    start.kinetic_energy = end.kinetic_energy = 8; // sqrt(2 M K) is 4, sqrt(2 K sum m r^2) is 8
    start.potential_energy = end.potential_energy = -24;
    start.mass = end.mass = 1;
    start.second_moment = end.second_moment = 4;
    end.momentum = {1, 0, 0};
    end.angular_momentum = {0, 0, 1};
    end.potential_energy = -22;
    const Drifts changes = drifts(start, end);
    EXPECT_EQ(changes.momentum, 0.25);
    EXPECT_EQ(changes.angular_momentum, 0.125);
    EXPECT_EQ(changes.energy, 2.0 / 16);
}

TEST(CostSweep, WhatIsNotConservedHasNoDrift)
{
    SimulationSettings scene = attracting();
    scene.uniform_wind.emplace();
    scene.linear_drag.emplace();
    const Sweep sweep = sweep_anew(scene, [](std::uint64_t seed) { return cloud(100, seed); },
                                   {.frames = 10, .seeds = 1, .rounds = 0});
    EXPECT_TRUE(std::isnan(sweep.rows[0].drifts.energy));
    EXPECT_TRUE(std::isnan(sweep.rows[0].drifts.momentum));
}

// The clock ticks at each reading: a frame takes as long as its phases and what is between them.
TEST(CostSweep, AFramesTimeIsThatOfItsPhasesAndItsSteps)
{
    SweepPlan plan = two_motions;
    plan.settings = {{.motion = Motion::Flow, .max_cluster_size = 8, .steps = 2}};
    const Sweep sweep = small_sweep(plan);
    const Row& one = sweep.rows[0];
    const Row& two = sweep.rows[1];
    EXPECT_GT(one.phases[Phase::Forces], 0);
    EXPECT_LT(one.phases.total(), one.ms_median);
    EXPECT_EQ(two.phases[Phase::Forces], 2 * one.phases[Phase::Forces]);
    EXPECT_GT(two.ms_median, 1.8 * one.ms_median);
}

// Another seed is one noise floor away by its definition; half the gravity is far more.
TEST(CostSweep, ABrokenRunIsFlagged)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace();
    ParticleSet particles;
    test::add_cloud(particles, {.count = 2000}, 1);
    const auto run = [&](double strength, std::uint64_t seed) {
        SimulationSettings settings = with_setting(scene, {.max_cluster_size = 1});
        settings.gravity->strength = strength;
        ParticleSet cloud;
        test::add_cloud(cloud, {.count = 2000}, seed);
        double now = 0;
        return run_trial(
                   settings, cloud, {250, 1, false}, [&] { return now += 1; }, [](int) {})
            .particles;
    };
    const Points good = positions(run(1, 1)), other = positions(run(1, 2)), broken = positions(run(0.5, 1));
    EXPECT_GT(sliced_wasserstein(good, broken), 3 * sliced_wasserstein(good, other));
}

TEST(CostSweep, AFixedCloudHasItsFloorFromBootstrapSamples)
{
    const Sweep sweep = sweep_anew(attracting(), [](std::uint64_t) { return cloud(200, 1); },
                                   {.frames = 10, .seeds = 2, .rounds = 0});
    EXPECT_TRUE(sweep.floor.resampled);
    EXPECT_GT(sweep.floor.position, 0);
}

TEST(CostSweep, EachMotionIsVariedAboutItsOwnFront)
{
    SweepPlan plan = two_motions;
    plan.rounds = 1;
    plan.points = 1;
    plan.clocks = {0.5};
    const Sweep sweep = small_sweep(plan);
    std::vector<std::string> names;
    for (const Row& row : sweep.rows)
        names.push_back(row.setting.name());
    const std::vector<std::string> wanted{"unclustered",       "flow 8",          "rigid 8",
                                          "flow 8, clock 0.1", "flow 8, 2 steps", "flow 8, double",
                                          "rigid 8, 2 steps",  "rigid 8, double"};
    EXPECT_EQ(names, wanted);
}

} // namespace
} // namespace slod::cost
