#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/command_desk.hpp"
#include "app/regulator.hpp"
#include "app/trace.hpp"
#include "support/case_rows.hpp"
#include "support/drifting_cloud.hpp"
#include "support/scratch_folder.hpp"
#include "support/small_scenes.hpp"

// What holds the frame rate, beside the loop: a cloud of particles whose frames take a millisecond per
// cluster.
namespace slod {
namespace {

class Regulated : public testing::Test {
protected:
    /// Runs frames as the server does.
    void run(int frames, const LoopSettings& loop)
    {
        for (int i = 0; i < frames; ++i) {
            ++frame;
            regulator.set(loop, editor, simulation);
            regulator.apply(editor, frame);
            const Snapshot& snapshot = simulation.step({});
            regulator.add(snapshot, double(snapshot.counts.clusters), simulation.take_error_samples());
        }
    }

    static LoopSettings loop(ControlMode mode, double target_ms)
    {
        LoopSettings settings;
        settings.control.mode = mode;
        settings.control.work_share = 0.5;
        settings.server.frame_rate = 1000 / (2 * target_ms);
        return settings;
    }

    Simulation simulation = test::drifting_cloud(64);
    SceneEditor editor{simulation};
    Regulator regulator{true};
    std::uint64_t frame = 0;
};

TEST_F(Regulated, TheWorkComesToTheShareOfThePeriod)
{
    run(300, loop(ControlMode::Smooth, 300));
    EXPECT_NEAR(double(simulation.snapshot({}).counts.clusters), 300, 15);
    const ControlReport report = regulator.report();
    EXPECT_EQ(report.mode, ControlMode::Smooth);
    EXPECT_EQ(report.state, ControlState::Holding);
    EXPECT_NEAR(report.target_ms, 300, 1e-9);
    EXPECT_GT(report.decisions, 0U);
}

TEST_F(Regulated, N10_EveryDecisionIsInTheLogAndRepeatsTheRun)
{
    run(200, loop(ControlMode::Smooth, 300));
    const std::vector<LoggedCommand> log = editor.take_log();
    EXPECT_EQ(log.size(), regulator.report().decisions);
    test::expect_at_least("decisions repeated", double(log.size()), 10);
    Simulation again = test::drifting_cloud(64);
    SceneEditor repeating(again);
    auto next = log.begin();
    for (std::uint64_t f = 1; f <= 200; ++f) {
        for (; next != log.end() && next->frame == f; ++next)
            EXPECT_EQ(repeating.repeat(*next), Problems{});
        again.step({});
    }
    EXPECT_EQ(again.state_hash(), simulation.state_hash());
    test::expect_at_most("replays with another hash", again.state_hash() == simulation.state_hash() ? 0 : 1,
                         0);
}

TEST_F(Regulated, WithoutAControllerTheSceneHasItsOwnDetail)
{
    run(50, loop(ControlMode::Off, 300));
    EXPECT_EQ(simulation.detail(), Detail{});
    EXPECT_EQ(regulator.report().state, ControlState::Off);
    run(50, loop(ControlMode::Smooth, 300));
    EXPECT_NE(simulation.detail(), Detail{});
    run(2, loop(ControlMode::Off, 300));
    EXPECT_EQ(simulation.detail(), Detail{});
}

TEST_F(Regulated, AnotherControllerGoesOnFromTheDetailOfTheLast)
{
    run(300, loop(ControlMode::Smooth, 300));
    const double before = simulation.detail().cluster_size;
    run(1, loop(ControlMode::Paper, 300));
    EXPECT_EQ(simulation.detail().cluster_size, before);
    run(30, loop(ControlMode::Paper, 300));
    EXPECT_NE(simulation.detail().cluster_size, before);
    EXPECT_FALSE(simulation.detail().dithered);
}

// Without any force there is no error to hold, and the frame rate is; once there is one, the error is, which
// goes first here, so that frames may take three times as long.
TEST_F(Regulated, AnErrorIsHeldAsSoonAsAnEffectMakesOne)
{
    LoopSettings settings = loop(ControlMode::Error, 300);
    settings.control.priority = ControlPriority::Error;
    run(300, settings);
    EXPECT_NEAR(double(simulation.snapshot({}).counts.clusters), 300, 15);
    ASSERT_EQ(editor.set({{"gravity.strength", "1e-9"}}, frame + 1), Problems{});
    run(30, settings);
    const std::uint64_t clusters = simulation.snapshot({}).counts.clusters;
    for (int i = 0; i < 100; ++i) {
        regulator.apply(editor, ++frame);
        const Snapshot& snapshot = simulation.step({});
        regulator.add(snapshot, 3 * double(snapshot.counts.clusters), {});
    }
    EXPECT_NEAR(double(simulation.snapshot({}).counts.clusters), double(clusters), 0.1 * double(clusters));
}

TEST_F(Regulated, RegionsThatComeAreHeldToo)
{
    run(100, loop(ControlMode::Smooth, 300));
    RegionOfInterest fine;
    fine.name = "fine";
    fine.shape = Shape::Sphere;
    fine.radius = 0.5;
    fine.partition.max_cluster_size = 16;
    ASSERT_EQ(editor.add(fine, {}, 0, frame + 1), Problems{});
    run(100, loop(ControlMode::Smooth, 300));
    const Snapshot& now = simulation.snapshot({});
    EXPECT_NEAR(now.regions.front().max_cluster_size, 16 * simulation.detail().cluster_size, 1e-9);
    fine.partition.control_share = 0;
    ASSERT_EQ(editor.change(fine, frame + 1), Problems{});
    run(100, loop(ControlMode::Smooth, 400));
    EXPECT_EQ(simulation.snapshot({}).regions.front().max_cluster_size, 16);
}

// As one that follows a view does: further levers are turned after thirty frames in vain all the same.
TEST_F(Regulated, ARegionThatMovesEveryFrameHoldsNothingUp)
{
    RegionOfInterest seen;
    seen.name = "seen";
    seen.shape = Shape::Sphere;
    ASSERT_EQ(editor.add(seen, {}, 0, 1), Problems{});
    LoopSettings hopeless = loop(ControlMode::Smooth, 0.01);
    hopeless.control.largest_cluster_size = 64;
    for (int i = 0; i < 400; ++i) {
        seen.centre.x() = 1e-3 * i;
        ASSERT_EQ(editor.change(seen, frame + 1), Problems{});
        run(1, hopeless);
    }
    EXPECT_GT(simulation.detail().breadth, 1);
}

TEST(Regulator, LeavesASceneThatWasPlannedWithoutClustersAlone)
{
    Simulation simulation = test::drifting_cloud(1);
    SceneEditor editor(simulation);
    Regulator regulator{true};
    regulator.set({}, editor, simulation);
    regulator.add(simulation.step({}), 1000, {});
    regulator.apply(editor, 2);
    EXPECT_EQ(regulator.report().state, ControlState::Off);
    EXPECT_FALSE(simulation.set_detail({.cluster_size = 2}).empty());
}

/// One command to a desk that knows the loop's settings.
Answer set(CommandDesk& desk, const std::vector<Assignment>& settings, std::uint64_t revision = 0)
{
    static std::uint64_t number = 0;
    return desk.handle(
        {.client = {1}, .number = ++number, .kind = "set", .if_revision = revision, .settings = settings}, 1,
        CommandDesk::Clock::now());
}

TEST(LoopSettings, AreSetWhileTheSceneRuns)
{
    Simulation simulation = test::drifting_cloud(64);
    CommandDesk desk(simulation, {});
    EXPECT_EQ(set(desk, {{"server.frame_rate", "48"}, {"control.mode", "paper"}}).result,
              slod_v1_RESULT_APPLIED);
    EXPECT_EQ(desk.loop().server.frame_rate, 48);
    EXPECT_EQ(desk.loop().control.mode, ControlMode::Paper);
    EXPECT_TRUE(desk.editor().take_log().empty()) << "decisions are logged, not what leads to them";
}

TEST(LoopSettings, S32_ARateThatIsNoneIsRefused)
{
    Simulation simulation = test::drifting_cloud(64);
    CommandDesk desk(simulation, {});
    int refused = 0;
    for (const char* rate : {"nan", "0", "-30", "inf", "1e9", "\"fast\"", ""}) {
        const Answer answer = set(desk, {{"server.frame_rate", rate}});
        refused += answer.result == slod_v1_RESULT_INVALID ? 1 : 0;
        EXPECT_EQ(answer.field, "server.frame_rate") << rate;
    }
    test::expect_within("rates of 7 that are refused", refused, 7, 7);
    EXPECT_EQ(desk.loop().server.frame_rate, ServerSettings{}.frame_rate);
}

TEST(LoopSettings, WhatCannotChangeOrDoesNotFitIsRefused)
{
    Simulation simulation = test::drifting_cloud(64);
    CommandDesk desk(simulation, {});
    EXPECT_EQ(set(desk, {{"server.threads", "7"}}).result, slod_v1_RESULT_INVALID);
    EXPECT_EQ(set(desk, {{"control.smallest_cluster_size", "300"}}).field, "control.smallest_cluster_size");
    EXPECT_EQ(set(desk, {{"control.mode", "sideways"}}).field, "control.mode");
    EXPECT_EQ(set(desk, {{"control.mode", "off"}, {"motion.clock", "1"}}).field, "motion.clock");
    EXPECT_EQ(set(desk, {{"control.mode", "off"}}, 3).field, "if_revision");
    EXPECT_EQ(desk.loop().control, ControlSettings{});
    EXPECT_EQ(desk.loop().server.threads, ServerSettings{}.threads);
}

// Whoever moves an attractor from frame to frame leaves the frame rate held; another plan is another scene.
TEST_F(Regulated, GoesOnWhileValuesChangeUnderTheSamePlan)
{
    ASSERT_EQ(editor.set({{"attractor.0.strength", "1e-6"}}, 1), Problems{});
    const LoopSettings settings = loop(ControlMode::Smooth, 300);
    for (int i = 0; i < 300; ++i) {
        ASSERT_EQ(editor.set({{"attractor.0.position", "[" + std::to_string(i) + ", 0, 0]"}}, frame + 1),
                  Problems{});
        run(1, settings);
    }
    EXPECT_EQ(editor.plan_changes(), 1U);
    EXPECT_EQ(editor.effect_changes(), 301U);
    EXPECT_NEAR(double(simulation.snapshot({}).counts.clusters), 300, 15);
}

TEST(Trace, HasALineForEachFrame)
{
    const ScratchFolder scratch;
    const auto file = scratch.path() / "trace.csv";
    Simulation simulation = test::drifting_cloud(64);
    TraceWriter trace(file);
    for (int frame = 0; frame < 3; ++frame)
        trace.add(simulation.step({}), {.wall_s = 0.5, .step_ms = 2, .encode_ms = 0.25},
                  {.mode = ControlMode::Smooth, .state = ControlState::Holding, .target_ms = 3});
    trace.finish();
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_TRUE(lines[0].starts_with("frame,time,wall_s,step_ms,encode_ms,target_ms,state,"));
    EXPECT_TRUE(lines[3].starts_with("3,0.046875,0.500000,2.0000,0.2500,3.0000,holding,6000,")) << lines[3];
}

TEST(Trace, AFileThatCannotBeWrittenIsNamed)
{
    try {
        TraceWriter trace("/nowhere/trace.csv");
        FAIL();
    } catch (const std::system_error& error) {
        EXPECT_NE(std::string(error.what()).find("/nowhere/trace.csv"), std::string::npos);
    }
}

} // namespace
} // namespace slod
