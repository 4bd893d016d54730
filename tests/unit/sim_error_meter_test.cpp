#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/small_scenes.hpp"

// The error of accelerations, as the simulation measures it while it runs.
namespace slod::test {

namespace {

constexpr std::uint64_t all_there_is = 1U << 30U; ///< more pairs than a pass has

/// A cloud under its own attraction, so slow that it stays as it is.
SmallScene still_cloud(double max_cluster_size, std::uint64_t seed)
{
    SmallScene scene{"still", quiet_settings(), {}};
    scene.settings.gravity.emplace();
    scene.settings.time.step = 1e-9;
    scene.settings.background.max_cluster_size = max_cluster_size;
    scene.settings.seed = seed;
    add_cloud(scene.initial, {.count = 1500}, 5);
    return scene;
}

/// What a step of 1/1000 adds to the velocities, per time, by the particles' ids.
std::vector<Vector3d> accelerations(SmallScene scene)
{
    constexpr double step = 1e-3;
    scene.settings.time.step = step;
    Simulation simulation(scene.settings, scene.initial, {});
    const ParticleSet before = simulation.particles();
    simulation.step({});
    const ParticleSet after = simulation.particles();
    std::vector<Vector3d> given;
    for (std::size_t i = 0; i < before.size(); ++i)
        given.push_back((after[i].velocity - before[i].velocity) / step);
    return given;
}

/// Errors of all members' accelerations, got by another road: from what a step adds to their velocities, and
/// to those of single particles that attract each other in double. In it nothing moves by more than 1e-3 of
/// the cloud's size, and velocities are rounded by 1e-7 where clusters are formed anew, which is 1e-4 of an
/// acceleration; errors are a hundred times that.
std::vector<double> errors_by_velocities(const SmallScene& scene)
{
    SmallScene single = scene;
    single.settings.background.max_cluster_size = 1;
    for (RegionOfInterest& region : single.settings.regions)
        region.partition.max_cluster_size = 1;
    if (single.settings.gravity) {
        single.settings.gravity->precision = Precision::Double;
        single.settings.gravity->direct_below = 100'000;
    }
    const std::vector<Vector3d> given = accelerations(scene), exact = accelerations(single);
    std::vector<double> errors;
    for (std::size_t i = 0; i < given.size(); ++i)
        errors.push_back((given[i] - exact[i]).norm() / exact[i].norm());
    std::sort(errors.begin(), errors.end());
    return errors;
}

double quantile_of(const std::vector<double>& sorted, double q)
{
    return sorted[std::size_t(q * double(sorted.size()))];
}

ErrorEstimate measured(const SmallScene& scene, std::uint64_t samples)
{
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 200 && simulation.error().samples < samples; ++frame)
        simulation.step({.error_pairs = all_there_is});
    return simulation.error();
}

/// Scenes in which members get something else than they should for every reason that there is.
std::vector<SmallScene> inexact_scenes()
{
    std::vector<SmallScene> scenes;
    const auto add = [&](const std::string& name, Motion motion) -> SimulationSettings& {
        scenes.push_back(still_cloud(24, 1));
        scenes.back().name = name;
        scenes.back().settings.motion.motion = motion;
        return scenes.back().settings;
    };
    for (const auto& [name, motion] :
         {std::pair{"flow", Motion::Flow}, {"stream", Motion::Stream}, {"rigid", Motion::Rigid}}) {
        add(name, motion);
        SimulationSettings& dragged = add(std::string(name) + "_in_air", motion);
        dragged.linear_drag = LinearDragSettings{.rate = 0.7};
        dragged.uniform_wind = UniformWindSettings{.velocity = {0.5, 0, 0}};
        SimulationSettings& windy = add(std::string(name) + "_in_winds", motion);
        windy.gravity.reset();
        windy.linear_drag = LinearDragSettings{.rate = 2};
        windy.quadratic_drag = QuadraticDragSettings{.coefficient = 3};
        windy.fields.of<Turbulence>() = TurbulenceSettings{};
    }
    SmallScene kinds = small_scene("mixture");
    kinds.settings.time.step = 1e-9;
    scenes.push_back(kinds);
    SimulationSettings& apart = add("attracted_by_some", Motion::Flow);
    RegionOfInterest left;
    left.name = "left";
    left.shape = Shape::Box;
    left.centre = {-10, 0, 0};
    left.half_extent = {10, 10, 10};
    left.partition.max_cluster_size = 24;
    left.partition.attracts = Attracts::OwnRegion;
    apart.regions.push_back(left);
    return scenes;
}

class InexactScene : public testing::TestWithParam<SmallScene> {};

TEST_P(InexactScene, IsOffByWhatTheStepAddsToVelocities)
{
    const SmallScene& scene = GetParam();
    const std::vector<double> errors = errors_by_velocities(scene);
    const ErrorEstimate estimate = measured(scene, 1024);
    ASSERT_GE(estimate.samples, 1024U);
    // Three standard deviations of a quantile are 1.5 times half of its interval of 95 %; the two roads
    // differ by a hundredth.
    const auto expect_quantile = [&](const ErrorQuantile& quantile, double q) {
        const double all = quantile_of(errors, q);
        const double off = 1.5 * std::max(quantile.high - quantile.value, quantile.value - quantile.low);
        EXPECT_NEAR(quantile.value, all, off + 0.01 * all + 3e-4) << q;
    };
    expect_quantile(estimate.median, 0.5);
    expect_quantile(estimate.p90, 0.9);
    EXPECT_GT(estimate.median.value, 2e-3) << "nothing was compared";
}

INSTANTIATE_TEST_SUITE_P(Ways, InexactScene, testing::ValuesIn(inexact_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(ErrorMeter, IntervalsHoldTheMedianOfAllMembersAsOftenAsTheySay)
{
    const std::vector<double> errors = errors_by_velocities(still_cloud(16, 1));
    int median_held = 0, p99_held = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const ErrorEstimate estimate = measured(still_cloud(16, seed), 500);
        const auto holds = [&](const ErrorQuantile& quantile, double q) {
            const double all = quantile_of(errors, q);
            return quantile.low <= all * 1.02 && all * 0.98 <= quantile.high; // the two roads differ by that
        };
        median_held += holds(estimate.median, 0.5) ? 1 : 0;
        p99_held += holds(estimate.p99, 0.99) ? 1 : 0;
    }
    EXPECT_GE(median_held, 90);
    EXPECT_GE(p99_held, 90);
}

TEST(ErrorMeter, OfSingleParticlesAndDirectSumsIsThatOfTheKernels)
{
    SmallScene scene = still_cloud(1, 1);
    scene.settings.gravity->direct_below = 1e6;
    const ErrorEstimate estimate = measured(scene, 512);
    EXPECT_LT(estimate.p99.value, 1e-5); // sums in float of 1500 pulls: rounding of 6e-8 and sqrt(1500)
    EXPECT_GT(estimate.median.value, 0);
}

class MeteredScene : public testing::TestWithParam<SmallScene> {};

TEST_P(MeteredScene, HasTheSameOutcomeAndNothingIsLost)
{
    const SmallScene& scene = GetParam();
    Simulation metered(scene.settings, scene.initial, {}), left_alone(scene.settings, scene.initial, {});
    std::uint64_t pairs = 0;
    for (int frame = 1; frame <= 40; ++frame) {
        pairs += metered.step({.error_pairs = 4000}).counts.error_pairs;
        left_alone.step({});
        ASSERT_EQ(metered.state_hash(), left_alone.state_hash()) << "frame " << frame;
    }
    EXPECT_EQ(metered.problems(), Problems{});
    EXPECT_EQ(pairs > 0, scene.settings.gravity.has_value());
    EXPECT_EQ(left_alone.error().samples, 0U);
    if (metered.plan().has(Phase::Meter)) {
        EXPECT_GT(metered.error().samples, 0U);
        EXPECT_TRUE(std::isfinite(metered.error().rms));
    }
}

INSTANTIATE_TEST_SUITE_P(Small, MeteredScene, testing::ValuesIn(small_scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(ErrorMeter, SumsUpEachPairOfAParticleAndASampleOnce)
{
    const SmallScene scene = still_cloud(16, 1);
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t pairs = 0, frames = 0;
    while (simulation.error().samples == 0) {
        const std::uint64_t spent = simulation.step({.error_pairs = 1}).counts.error_pairs;
        EXPECT_LE(spent, ExactPulls::block_pairs + 64 * 16) << "a block and a cluster";
        pairs += spent;
        ASSERT_LT(++frames, 100U);
    }
    EXPECT_EQ(pairs, 1500 * simulation.error().samples);
}

TEST(ErrorMeter, TakesNothingAndKnowsNothingWhereItIsNotAsked)
{
    const SmallScene scene = still_cloud(16, 1);
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 10; ++frame)
        EXPECT_EQ(simulation.step({}).counts.error_pairs, 0U);
    EXPECT_EQ(simulation.error().samples, 0U);
    EXPECT_TRUE(simulation.region_errors().empty());
}

TEST(ErrorMeter, HasTheSameSamplesAtAnyNumberOfThreads)
{
    const auto samples = [](int threads) {
        std::vector<double> errors;
        ThreadTeam(threads).run([&] {
            const SmallScene scene = small_scene("flow");
            Simulation simulation(scene.settings, scene.initial, {});
            for (int frame = 0; frame < 20; ++frame)
                simulation.step({.error_pairs = 5000});
            for (const ErrorSample& sample : simulation.take_error_samples())
                errors.push_back(sample.error);
        });
        return errors;
    };
    const std::vector<double> one = samples(1);
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(samples(3), one);
}

/// More than is summed up in one block.
SmallScene large_cloud()
{
    SmallScene scene{"large", quiet_settings(), {}};
    scene.settings.gravity.emplace();
    scene.settings.background.max_cluster_size = 16;
    add_cloud(scene.initial, {.count = 40'000}, 5);
    return scene;
}

// What is summed up later is of the frame in which the sums began, though clusters are formed anew meanwhile.
TEST(ErrorMeter, HasTheSameSamplesHoweverManyFramesTheSumsTake)
{
    const SmallScene scene = large_cloud();
    const auto samples = [&](std::uint64_t pairs, std::uint64_t least_frames) {
        Simulation simulation(scene.settings, scene.initial, {});
        std::uint64_t frames = 0, formed = 0;
        for (; simulation.error().samples == 0 && frames < 40; ++frames)
            formed += simulation.step({.error_pairs = pairs}).counts.reformed_members;
        EXPECT_GE(frames, least_frames);
        EXPECT_GE(formed, frames > 1 ? scene.initial.size() / 4 : 0);
        std::vector<double> errors;
        for (const ErrorSample& sample : simulation.take_error_samples()) {
            EXPECT_EQ(sample.frame, 1U);
            errors.push_back(sample.error);
        }
        return errors;
    };
    const std::vector<double> at_once = samples(all_there_is, 1);
    EXPECT_GE(at_once.size(), 8U);
    EXPECT_EQ(samples(1, 8), at_once);
}

// Rows of members are kept for sums that are under way: not for ever.
TEST(ErrorMeter, GivesUpWhatIsNotGoneOnWith)
{
    const SmallScene scene = large_cloud();
    Simulation simulation(scene.settings, scene.initial, {});
    simulation.step({.error_pairs = 1});
    for (std::uint64_t frame = 0; frame < ErrorMeter::late_frames; ++frame)
        simulation.step({});
    simulation.step({.error_pairs = all_there_is});
    EXPECT_EQ(simulation.take_error_samples().front().frame, ErrorMeter::late_frames + 2);
}

TEST(ErrorMeter, ForgetsWhenItIsTold)
{
    const SmallScene scene = still_cloud(16, 1);
    Simulation simulation(scene.settings, scene.initial, {});
    simulation.step({.error_pairs = all_there_is});
    EXPECT_GT(simulation.error().samples, 0U);
    simulation.forget_errors();
    EXPECT_EQ(simulation.error().samples, 0U);
    EXPECT_TRUE(simulation.region_errors().empty());
    EXPECT_TRUE(simulation.take_error_samples().empty());
}

// Half of the members are drawn by region, so that a small one is heard of.
TEST(ErrorMeter, TellsEveryRegionsErrorApart)
{
    SmallScene scene = still_cloud(64, 1);
    RegionOfInterest fine;
    fine.name = "fine";
    fine.shape = Shape::Sphere;
    fine.centre = {1, 0, 0};
    fine.radius = 0.4;
    fine.partition.max_cluster_size = 1;
    scene.settings.regions.push_back(fine);
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t inside = 0;
    for (int frame = 0; frame < 24; ++frame)
        inside = simulation.step({.error_pairs = all_there_is}).regions.front().particles;
    ASSERT_GT(inside, 5U);
    ASSERT_LT(inside, 150U);
    const std::vector<RegionError> regions = simulation.region_errors();
    ASSERT_EQ(regions.size(), 2U);
    const bool background_first = regions.front().row == background_row;
    const ErrorEstimate& of_fine = regions[background_first ? 1 : 0].error;
    const ErrorEstimate& of_rest = regions[background_first ? 0 : 1].error;
    EXPECT_GE(of_fine.samples, 24U * 12U);
    EXPECT_LT(of_fine.median.high, of_rest.median.low);
}

} // namespace
} // namespace slod::test
