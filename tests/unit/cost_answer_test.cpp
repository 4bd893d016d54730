#include "cost_rows.hpp"

#include <gtest/gtest.h>

#include "cost/answer.hpp"
#include "cost/report_files.hpp"
#include "support/small_scenes.hpp"

namespace slod::cost {
namespace {

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

// The first is beaten by the same size at another clock, which is beaten by none.
TEST(CostAnswer, TheFrontIsOverAllValues)
{
    const std::vector<Row> rows{
        row({.motion = Motion::Flow, .max_cluster_size = 16}, 10, 3),
        row({.motion = Motion::Flow, .max_cluster_size = 16, .clock = 0.4}, 8, 3),
        row({.motion = Motion::Flow, .max_cluster_size = 16, .steps = 2}, 20, 1),
        row({.motion = Motion::Flow, .max_cluster_size = 16, .precision = Precision::Double}, 30, 1)};
    const std::vector<Row> front = pareto_front(rows, Motion::Flow);
    ASSERT_EQ(front.size(), 2U);
    EXPECT_EQ(front[0].setting.name(), "flow 16, clock 0.4");
    EXPECT_EQ(front[1].setting.name(), "flow 16, 2 steps");
}

TEST(CostAnswer, NamesTheBestWithinATimeAndTheFastestWithinAnError)
{
    std::vector<Row> rows{row(Motion::Flow, 1, 100, 0), row(Motion::Flow, 4, 30, 1.5),
                          row(Motion::Flow, 16, 10, 4)};
    EXPECT_EQ(best_within(rows, 33)->setting.max_cluster_size, 4);
    EXPECT_FALSE(best_within(rows, 5));
    EXPECT_EQ(fastest_within(rows, 2)->setting.max_cluster_size, 4);
    EXPECT_TRUE(fastest_within(rows, 1)->setting.unclustered());
    EXPECT_FALSE(fastest_within(rows, -1));
    const std::string text = answer({.rows = rows});
    EXPECT_NE(text.find("at  30 frames a second      flow 4: 30.000 ms, 1.50"), std::string::npos) << text;
    EXPECT_NE(text.find("at 120 frames a second      none"), std::string::npos) << text;
    EXPECT_EQ(text.find("accelerations"), std::string::npos) << text;
    rows[1].force.median = 0.004;
    const std::string with_forces = answer({.rows = rows});
    EXPECT_NE(with_forces.find("accelerations to 1.0 %      flow 4: "), std::string::npos) << with_forces;
    EXPECT_NE(with_forces.find("accelerations to 0.1 %      none"), std::string::npos) << with_forces;
}

TEST(CostSetting, NamesAllThatItChanges)
{
    EXPECT_EQ((Setting{Motion::Rigid, 4, 0.1, 0.01, 2, Precision::Double}).name(),
              "rigid 4, clock 0.1, opening 0.01, 2 steps, double");
    EXPECT_EQ((Setting{.max_cluster_size = 1, .steps = 2}).name(), "unclustered, 2 steps");
}

TEST(CostSetting, ChangesWhatItSaysAndNothingElse)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace();
    scene.background.max_cluster_size = 16;
    scene.regions.emplace_back();
    scene.regions[0].partition.max_cluster_size = 4;
    const SimulationSettings same = with_setting(scene, {Motion::Flow, 16});
    EXPECT_EQ(same.motion, scene.motion);
    EXPECT_EQ(same.gravity, scene.gravity);
    EXPECT_EQ(same.time, scene.time);
    const SimulationSettings changed =
        with_setting(scene, {Motion::Stream, 32, 0.1, 0.01, 2, Precision::Double});
    EXPECT_EQ(changed.motion.motion, Motion::Stream);
    EXPECT_EQ(changed.background.max_cluster_size, 32);
    EXPECT_EQ(changed.regions[0].partition.max_cluster_size, 8);
    EXPECT_EQ(changed.motion.clock, 0.1);
    EXPECT_EQ(changed.gravity->force_tolerance, 0.01);
    EXPECT_EQ(changed.gravity->precision, Precision::Double);
    EXPECT_EQ(changed.time.step, scene.time.step / 2);
}

TEST(CostSetting, OpeningIsThatOfTheScenesOwnCriterion)
{
    GravitySettings gravity;
    EXPECT_STREQ(opening_of(gravity).key, "force_tolerance");
    gravity.opening = OpeningCriterion::Geometric;
    EXPECT_STREQ(opening_of(gravity).key, "opening_angle");
    gravity.accuracy = 0.001;
    EXPECT_STREQ(opening_of(gravity).key, "accuracy");
}

TEST(CostFiles, APictureMayBeInAFolderOfAnyName)
{
    const Sweep sweep{.rows = {row(Motion::Flow, 1, 100, 0), row(Motion::Flow, 16, 10, 4)}};
    const std::string script = plot_script(sweep, {}, "it's/cost");
    EXPECT_NE(script.find("set output 'it''s/cost.png'"), std::string::npos) << script;
}

TEST(CostFiles, TheTableHasALinePerSettingAndNothingForWhatIsNotKnown)
{
    Sweep sweep{.rows = {row(Motion::Flow, 1, 100, 0), row({Motion::Rigid, 16, 0.1, {}, 2}, 10, 4)}};
    sweep.rows[1].force.median = 0.25;
    const std::string csv = csv_text(sweep);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_TRUE(csv.starts_with("motion,max_cluster_size,clock,opening,steps,precision,error,")) << csv;
    EXPECT_NE(csv.find("\nunclustered,1.0,,,1,,0.0,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\nrigid,16.0,0.1,,2,,4.0,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",0.25,,,,,,,"), std::string::npos) << csv; // no p90, p99, max and drifts
    EXPECT_NE(csv.find(",ms_forces,"), std::string::npos) << csv;
}

} // namespace
} // namespace slod::cost
