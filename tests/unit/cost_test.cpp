#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "cost/answer.hpp"
#include "cost/metrics.hpp"
#include "cost/report_files.hpp"
#include "cost/sweep.hpp"
#include "support/clouds.hpp"
#include "support/small_scenes.hpp"

namespace slod::cost {
namespace {

Points ball(std::size_t count, std::uint64_t seed, const Vector3d& centre = {0, 0, 0})
{
    return positions(test::ball(count, 1, 1, seed, centre));
}

TEST(CostMetrics, TheSameCloudInAnyOrderIsAtNoDistance)
{
    const Points a = ball(1000, 1);
    Points b = a;
    std::reverse(b.begin(), b.end());
    EXPECT_EQ(sliced_wasserstein(a, b), 0);
    EXPECT_EQ(density_distance(a, b, 0.3), 0);
}

// The mean of |cos| over the sphere is 1/2; a spiral of 64 directions has it to a thousandth.
TEST(CostMetrics, AShiftIsAtHalfItsLength)
{
    const Points a = ball(1000, 1);
    for (const Vector3d& shift : {Vector3d(0.7, 0, 0), Vector3d(0, 0, 0.7), Vector3d(0.4, -0.4, 0.4)}) {
        Points b = a;
        for (Vector3d& point : b)
            point += shift;
        EXPECT_NEAR(sliced_wasserstein(a, b), shift.norm() / 2, 0.02 * shift.norm());
        EXPECT_NEAR(sliced_wasserstein(b, a), sliced_wasserstein(a, b), 1e-12);
    }
}

// Along each axis the two halves are one and two away: the area is what one unit of length times the shares
// is.
TEST(CostMetrics, CloudsOfDifferentNumberAreCompared)
{
    const Points twice{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, once{{0, 0, 0}, {1, 0, 0}};
    EXPECT_NEAR(sliced_wasserstein(twice, once), 0, 1e-15);
    const Points three{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    EXPECT_NEAR(sliced_wasserstein(once, three), (1.0 / 6) / 2, 0.01); // a sixth has moved by one
}

TEST(CostMetrics, DensitiesWithoutACubeInCommonAreAtDistanceOne)
{
    EXPECT_NEAR(density_distance(ball(500, 1), ball(500, 2, {10, 0, 0}), 0.5), 1, 1e-12);
    const Points a{{0.1, 0, 0}, {1.1, 0, 0}}, b{{0.1, 0, 0}, {2.1, 0, 0}};
    EXPECT_NEAR(density_distance(a, b, 1), 0.5, 1e-15);
}

TEST(CostMetrics, EmptyCloudsHaveAnAnswer)
{
    EXPECT_EQ(sliced_wasserstein({}, {}), 0);
    EXPECT_TRUE(std::isinf(sliced_wasserstein({}, ball(3, 1))));
    EXPECT_EQ(density_distance({}, ball(3, 1), 1), 1);
    EXPECT_EQ(lagrangian_radius({}, 0.5), 0);
}

// A homogeneous ball of radius 1: half its points within 2^(-1/3), rms radius sqrt(3/5).
TEST(CostMetrics, RadiiOfAHomogeneousBall)
{
    const Points points = ball(20'000, 3);
    EXPECT_NEAR(lagrangian_radius(points, 0.5), std::cbrt(0.5), 0.01);
    EXPECT_NEAR(rms_radius(points), std::sqrt(0.6), 0.01);
}

TEST(CostMetrics, ParticlesAreComparedByTheirIds)
{
    ParticleSet a = test::ball(101, 1, 1, 1), b = a;
    for (Particle& particle : b)
        particle.position.x() += 0.25;
    b.erase(b.begin() + 3);
    EXPECT_NEAR(median_displacement(a, b), 0.25, 1e-12);
    EXPECT_TRUE(std::isnan(median_displacement(a, {})));
}

/// A cloud in its own gravity, swept over two sizes.
Sweep small_sweep(double strength = 1)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace().strength = strength;
    const auto initial = [](std::uint64_t seed) {
        ParticleSet particles;
        test::add_cloud(particles, {.count = 600}, seed);
        return particles;
    };
    SweepPlan plan{.settings = {{Motion::Flow, 8}, {Motion::Rigid, 8}}, .frames = 60, .seeds = 3};
    double now = 0;
    return run_sweep(
        scene, initial, plan, [&] { return now += 1; }, [](const std::string&, double) {});
}

TEST(CostSweep, TheUnclusteredRunComesFirstAndHasNoError)
{
    const Sweep sweep = small_sweep();
    ASSERT_EQ(sweep.rows.size(), 3U);
    EXPECT_EQ(sweep.rows[0].setting.name(), "unclustered");
    EXPECT_EQ(sweep.rows[0].errors.largest(), 0);
    EXPECT_EQ(sweep.rows[0].clusters, 600U);
    EXPECT_EQ(sweep.rows[0].r50, 1);
    EXPECT_EQ(sweep.rows[0].median_displacement, 0);
    EXPECT_FALSE(sweep.floor.resampled);
    EXPECT_GT(sweep.floor.position, 0);
}

TEST(CostSweep, RigidClustersAreFartherOffThanThoseThatFlow)
{
    const Sweep sweep = small_sweep();
    EXPECT_GT(sweep.rows[2].errors.largest(), sweep.rows[1].errors.largest());
    EXPECT_GT(sweep.rows[2].median_displacement, sweep.rows[1].median_displacement);
    EXPECT_LT(sweep.rows[1].clusters, 200U);
}

// Two seeds are about one noise floor apart by its definition; a scene with half the gravity is far more.
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
                   settings, cloud, 250, [&] { return now += 1; }, [](int) {})
            .particles;
    };
    const Points good = positions(run(1, 1)), other = positions(run(1, 2)), broken = positions(run(0.5, 1));
    EXPECT_GT(sliced_wasserstein(good, broken), 3 * sliced_wasserstein(good, other));
}

TEST(CostSweep, AFixedCloudHasItsFloorFromBootstrapSamples)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace();
    const auto initial = [](std::uint64_t) {
        ParticleSet particles;
        test::add_cloud(particles, {.count = 200}, 1);
        return particles;
    };
    double now = 0;
    const Sweep sweep = run_sweep(
        scene, initial, {.settings = {}, .frames = 10, .seeds = 2}, [&] { return now += 1; },
        [](const std::string&, double) {});
    EXPECT_TRUE(sweep.floor.resampled);
    EXPECT_GT(sweep.floor.position, 0);
}

Row row(Motion motion, double size, double ms, double error)
{
    Row made;
    made.setting = {motion, size};
    made.ms_median = ms;
    made.errors.position = error;
    return made;
}

TEST(CostAnswer, TheFrontHasWhatNothingBeats)
{
    const std::vector<Row> rows{row(Motion::Flow, 1, 100, 0), row(Motion::Flow, 4, 30, 1),
                                row(Motion::Flow, 8, 35, 2), row(Motion::Flow, 16, 10, 3),
                                row(Motion::Rigid, 16, 5, 1)};
    const std::vector<Row> front = pareto_front(rows, Motion::Flow);
    ASSERT_EQ(front.size(), 3U);
    EXPECT_EQ(front[0].setting.max_cluster_size, 16);
    EXPECT_EQ(front[1].setting.max_cluster_size, 4);
    EXPECT_TRUE(front[2].setting.unclustered());
}

TEST(CostAnswer, NamesTheBestWithinATimeAndTheFastestWithinAnError)
{
    const std::vector<Row> rows{row(Motion::Flow, 1, 100, 0), row(Motion::Flow, 4, 30, 1.5),
                                row(Motion::Flow, 16, 10, 4)};
    EXPECT_EQ(best_within(rows, 33)->setting.max_cluster_size, 4);
    EXPECT_FALSE(best_within(rows, 5));
    EXPECT_EQ(fastest_within(rows, 2)->setting.max_cluster_size, 4);
    EXPECT_TRUE(fastest_within(rows, 1)->setting.unclustered());
    const std::string text = answer({.rows = rows, .floor = {}});
    EXPECT_NE(text.find("at  30 frames a second   flow 4"), std::string::npos) << text;
    EXPECT_NE(text.find("at 120 frames a second   none"), std::string::npos) << text;
}

TEST(CostFiles, APictureMayBeInAFolderOfAnyName)
{
    const Sweep sweep{.rows = {row(Motion::Flow, 1, 100, 0), row(Motion::Flow, 16, 10, 4)}, .floor = {}};
    const std::string script = plot_script(sweep, {}, "it's/cost");
    EXPECT_NE(script.find("set output 'it''s/cost.png'"), std::string::npos) << script;
}

TEST(CostFiles, TheTableHasALinePerSetting)
{
    const Sweep sweep{.rows = {row(Motion::Flow, 1, 100, 0), row(Motion::Rigid, 16, 10, 4)}, .floor = {}};
    const std::string csv = csv_text(sweep);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_TRUE(csv.starts_with("motion,max_cluster_size,ms_median,"));
    EXPECT_NE(csv.find("\nrigid,16.0,10.0,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\nunclustered,1.0,100.0,"), std::string::npos) << csv;
}

} // namespace
} // namespace slod::cost
