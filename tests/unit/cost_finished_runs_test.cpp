#include <cmath>
#include <fstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "cost/finished_runs.hpp"
#include "cost/sweep.hpp"
#include "support/small_scenes.hpp"

namespace slod::cost {
namespace {

/// A file that is not there at the start, nor after the test.
class FinishedRunsTest : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(file); }

    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("slod_finished_runs_" + std::to_string(getpid()));
};

using Json = FinishedRuns::Json;

TEST_F(FinishedRunsTest, AreThereTheNextTimeWithEveryDigit)
{
    FinishedRuns(file, {{"frames", 10}}, false).add("flow 8", {{"ms", 1.0 / 3}});
    const FinishedRuns again(file, {{"frames", 10}}, false);
    ASSERT_NE(again.find("flow 8"), nullptr);
    EXPECT_EQ((*again.find("flow 8"))["ms"], 1.0 / 3);
    EXPECT_EQ(again.find("flow 16"), nullptr);
}

TEST_F(FinishedRunsTest, OfOtherCircumstancesAreNotTaken)
{
    FinishedRuns(file, {{"frames", 10}, {"threads", 2}}, false).add("flow 8", 1);
    FinishedRuns(file, {{"frames", 10}, {"threads", 1}}, false).add("flow 16", 2);
    const FinishedRuns two(file, {{"frames", 10}, {"threads", 2}}, false);
    EXPECT_NE(two.find("flow 8"), nullptr);
    EXPECT_EQ(two.find("flow 16"), nullptr);
    EXPECT_EQ(FinishedRuns(file, {{"frames", 11}, {"threads", 2}}, false).find("flow 8"), nullptr);
}

TEST_F(FinishedRunsTest, AFreshStartForgetsThem)
{
    FinishedRuns(file, {}, false).add("flow 8", 1);
    EXPECT_EQ(FinishedRuns(file, {}, true).find("flow 8"), nullptr);
    EXPECT_EQ(FinishedRuns(file, {}, false).find("flow 8"), nullptr);
}

TEST_F(FinishedRunsTest, ALineThatWasCutOffSpoilsNoOther)
{
    FinishedRuns(file, {}, false).add("flow 8", 1);
    std::ofstream(file, std::ios::app) << R"({"run":"flow 16","of":nu)";
    FinishedRuns(file, {}, false).add("flow 32", 3);
    const FinishedRuns again(file, {}, false);
    EXPECT_NE(again.find("flow 8"), nullptr);
    EXPECT_EQ(again.find("flow 16"), nullptr);
    EXPECT_NE(again.find("flow 32"), nullptr);
}

TEST_F(FinishedRunsTest, AFileThatCannotBeWrittenIsRefusedAtOnce)
{
    EXPECT_THROW(FinishedRuns("/proc/no/such/file", {}, false), std::runtime_error);
}

/// Sweeps a cloud, and counts the frames that are run.
Sweep sweep(const SweepPlan& plan, FinishedRuns& finished, int& frames)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace();
    const auto initial = [](std::uint64_t seed) {
        ParticleSet particles;
        test::add_cloud(particles, {.count = 200}, seed);
        return particles;
    };
    double now = 0;
    const Clock ticking = [&] { return now += 1; };
    return run_sweep(
        scene, initial, plan, ticking, [&](const std::string&, double) { ++frames; }, finished);
}

const SweepPlan flow_then_rigid{
    .settings = {{Motion::Flow, 8}, {Motion::Rigid, 8}}, .frames = 20, .seeds = 2, .rounds = 1};

TEST_F(FinishedRunsTest, AreNotRunAgainAndGiveTheSameRows)
{
    int frames = 0, frames_again = 0;
    FinishedRuns runs(file, {}, false);
    const Sweep first = sweep(flow_then_rigid, runs, frames);
    EXPECT_EQ(first.known, 0);
    FinishedRuns runs_again(file, {}, false);
    const Sweep again = sweep(flow_then_rigid, runs_again, frames_again);
    EXPECT_GT(frames, 0);
    EXPECT_EQ(frames_again, 0);
    EXPECT_EQ(again.known, again.runs);
    ASSERT_EQ(again.rows.size(), first.rows.size());
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
        SCOPED_TRACE(first.rows[i].setting.name());
        EXPECT_EQ(again.rows[i].setting, first.rows[i].setting);
        EXPECT_EQ(again.rows[i].in_full, first.rows[i].in_full);
        EXPECT_EQ(again.rows[i].errors.largest(), first.rows[i].errors.largest());
        for_each_number(first.rows[i], [&](const std::string& name, double number) {
            for_each_number(again.rows[i], [&](const std::string& other, double same) {
                EXPECT_TRUE(name != other || same == number || (std::isnan(same) && std::isnan(number)))
                    << name;
            });
        });
    }
}

TEST_F(FinishedRunsTest, OfASweepThatWasCutShortAreASubsetOfTheWhole)
{
    SweepPlan short_plan = flow_then_rigid;
    short_plan.settings.pop_back();
    short_plan.rounds = 0;
    int frames = 0, frames_rest = 0, frames_whole = 0;
    FinishedRuns runs(file, {}, false);
    sweep(short_plan, runs, frames);
    FinishedRuns runs_rest(file, {}, false);
    const Sweep rest = sweep(flow_then_rigid, runs_rest, frames_rest);
    FinishedRuns none;
    const Sweep whole = sweep(flow_then_rigid, none, frames_whole);
    EXPECT_EQ(rest.known, 2); // unclustered, flow 8
    EXPECT_LT(frames_rest, frames_whole);
    ASSERT_EQ(rest.rows.size(), whole.rows.size());
    for (std::size_t i = 0; i < rest.rows.size(); ++i) {
        EXPECT_EQ(rest.rows[i].setting, whole.rows[i].setting);
        EXPECT_EQ(rest.rows[i].errors.largest(), whole.rows[i].errors.largest());
    }
}

TEST(Fingerprint, ChangesWithTheSceneAndWithEachParticle)
{
    Scene scene;
    ParticleSet particles;
    test::add_cloud(particles, {.count = 10}, 1);
    const std::string own = fingerprint(scene, particles);
    EXPECT_EQ(own.size(), 16U);
    EXPECT_EQ(fingerprint(scene, particles), own);
    ParticleSet moved = particles;
    moved[9].velocity.z() += 1e-9;
    EXPECT_NE(fingerprint(scene, moved), own);
    scene.simulation.background.max_cluster_size += 1;
    EXPECT_NE(fingerprint(scene, particles), own);
}

} // namespace
} // namespace slod::cost
