#include <cstdint>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/clouds.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"

// What a change of regions, settings or detail leaves as it is in a running scene, and what it sets off.
namespace slod::test {
namespace {

class NoChange : public testing::TestWithParam<const char*> {};

// Whatever acts on later frames is in the hash, so a change that keeps the hash of the next frame and not of
// all would show a state that it does not cover.
TEST_P(NoChange, OfTheBackgroundOrTheDetailChangesNoLaterFrame)
{
    const SmallScene scene = small_scene(GetParam());
    Simulation left_alone(scene.settings, scene.initial, {}), changed(scene.settings, scene.initial, {});
    for (int frame = 1; frame <= 60; ++frame) {
        if (frame == 10) {
            ASSERT_EQ(changed.change_region(changed.regions().back().settings), Problems{});
            if (!changed.plan().unclustered) {
                ASSERT_EQ(changed.set_detail(changed.detail()), Problems{});
            }
        }
        left_alone.step({});
        changed.step({});
        ASSERT_EQ(changed.state_hash(), left_alone.state_hash()) << "frame " << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, NoChange,
                         testing::Values("fountain", "flow", "rigid", "regions", "unclustered"),
                         [](const auto& scene) { return std::string(scene.param); });

/// Merges in 40 frames of a resting cloud in exact flow, once its background allows larger clusters and
/// something else has changed too.
std::uint64_t merges_after(const std::function<void(Simulation&)>& change)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 4;
    Simulation simulation(settings, ball(200, 1, 0, 1), {});
    RegionOfInterest background = simulation.regions().back().settings;
    background.partition.max_cluster_size = 64;
    EXPECT_EQ(simulation.change_region(background), Problems{});
    change(simulation);
    std::uint64_t merges = 0;
    for (int frame = 0; frame < 40; ++frame)
        merges += simulation.step({}).counts.merges;
    return merges;
}

TEST(Merging, BeginsInExactFlowWithTheFirstRegionOrAnotherDetailAndNotWithAChangeOfTheBackground)
{
    EXPECT_EQ(merges_after([](Simulation&) {}), 0U);
    EXPECT_GT(merges_after([](Simulation& simulation) {
                  EXPECT_EQ(simulation.add_region(ball_region("far", {50, 0, 0}, 1, 4)), Problems{});
              }),
              0U);
    EXPECT_GT(merges_after([](Simulation& simulation) {
                  EXPECT_EQ(simulation.set_detail({.cluster_size = 2}), Problems{});
              }),
              0U);
}

// Scalar maps are closed forms of the age, so that a shape is no longer the same a frame later. That the
// background attracts its own region alone makes no difference where there is no other, but that forces are
// evaluated once more before the next frame.
TEST(ForcesThatAreEvaluatedAgain, AreThoseOfTheFrameThatHasEnded)
{
    const SmallScene scene = small_scene("stream");
    Simulation left_alone(scene.settings, scene.initial, {}), changed(scene.settings, scene.initial, {});
    RegionOfInterest background = changed.regions().back().settings;
    background.partition.attracts = Attracts::OwnRegion;
    run(left_alone, 7);
    run(changed, 7);
    ASSERT_EQ(changed.change_region(background), Problems{});
    run(left_alone, 1);
    run(changed, 1);
    EXPECT_EQ(rms_distance(changed.particles(), left_alone.particles()), 0);
}

/// Pools whose lives end in the frame after a region about the middle of "flow" was changed.
std::uint64_t lives_ended_by(const std::function<void(RegionOfInterest&)>& change)
{
    SmallScene scene = small_scene("flow");
    scene.settings.regions = {ball_region("middle", {0, 0, 0}, 1.5, 8)};
    Simulation simulation(scene.settings, scene.initial, {});
    run(simulation, 20);
    RegionOfInterest region = scene.settings.regions[0];
    change(region);
    EXPECT_EQ(simulation.change_region(region), Problems{});
    return simulation.step({}).counts.due_pools;
}

TEST(ChangeOfARegion, EndsLivesWhereItsPlaceChangesAndNotForItsParametersAlone)
{
    const std::uint64_t ending_anyway = lives_ended_by([](RegionOfInterest&) {});
    EXPECT_EQ(lives_ended_by([](RegionOfInterest& region) { region.partition.max_cluster_size = 4; }),
              ending_anyway);
    EXPECT_GT(lives_ended_by([](RegionOfInterest& region) { region.radius = 1.6; }), ending_anyway);
}

} // namespace
} // namespace slod::test
