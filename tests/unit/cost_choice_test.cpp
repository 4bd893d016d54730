#include <gtest/gtest.h>

#include "cost/scene_choice.hpp"

namespace slod::cost {
namespace {

const SceneText scene_text{.name = "small.toml", .text = R"(# Two motions.
title = "Small"

[[kind]]
name = "star"

[motion]
kind = "flow"    # as they are wound up

[background]
max_cluster_size = 64  # some
max_breadth = 2.0

[[region]]
name = "near"
max_cluster_size = 8
centre = [0.0, 1.0,
          2.0]   # over two lines

[[region]]
name = "far"
max_cluster_size = 32 # coarse

[gravity]        # Newton's

[server]
frame_rate = 30.0
)"};

Scene scene_of(const SceneText& text, const std::vector<std::string>& overrides = {})
{
    const auto loaded = load_scene(text, overrides);
    if (const auto* problems = std::get_if<Problems>(&loaded))
        ADD_FAILURE() << problems->front() << "\n" << text.text;
    return std::get<Scene>(loaded);
}

Scene reread(const std::string& text)
{
    return scene_of({.name = "written", .text = text});
}

const Setting setting{Motion::Rigid, 16, 0.1, 0.01, 2, Precision::Double};

TEST(CostChoice, AWrittenSceneLoadsWithTheChosenSettingsAndNothingElseChanged)
{
    const Scene scene = scene_of(scene_text);
    const Scene chosen = with_choice(scene, setting, {.frame_rate_hz = 60});
    const Scene written = reread(edited(scene_text, chosen));
    EXPECT_EQ(to_toml(written), to_toml(chosen));
    EXPECT_EQ(written.simulation.motion.motion, Motion::Rigid);
    EXPECT_EQ(written.simulation.motion.clock, 0.1);
    EXPECT_EQ(written.simulation.background.max_cluster_size, 16);
    EXPECT_EQ(written.simulation.regions[0].partition.max_cluster_size, 2);
    EXPECT_EQ(written.simulation.regions[1].partition.max_cluster_size, 8);
    EXPECT_EQ(written.simulation.gravity->force_tolerance, 0.01);
    EXPECT_EQ(written.simulation.gravity->precision, Precision::Double);
    EXPECT_EQ(written.simulation.time.step, scene.simulation.time.step / 2);
    EXPECT_EQ(written.loop.server.frame_rate, 120);
    EXPECT_EQ(written.loop.control.mode, ControlMode::Off);
}

TEST(CostChoice, CommentsStayWhereTheyWere)
{
    const std::string text = edited(scene_text, with_choice(scene_of(scene_text), setting, {.error = 1}));
    EXPECT_TRUE(text.starts_with("# Two motions.\n")) << text;
    EXPECT_NE(text.find("\nkind = \"rigid\"   # as they are wound up\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\nmax_cluster_size = 16.0 # some\n"), std::string::npos) << text;
    EXPECT_NE(text.find("[gravity]        # Newton's\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\nframe_rate = 60.0\n"), std::string::npos) << text;
}

TEST(CostChoice, OverridesAreInTheWrittenSceneEvenWhereNoLineHoldsThem)
{
    for (const std::string change : {"background.max_breadth=3.0", "region=[{name=\"only\"}]", "seed=7"}) {
        SCOPED_TRACE(change);
        const Scene chosen = with_choice(scene_of(scene_text, {change}), setting, {.error = 1});
        EXPECT_EQ(to_toml(reread(edited(scene_text, chosen))), to_toml(chosen));
    }
}

Row row(double size, double ms, double error)
{
    Row made;
    made.setting.max_cluster_size = size;
    made.ms_median = ms;
    made.errors.position = error;
    return made;
}

TEST(CostChoice, TheMostExactAtAFrameRateOrTheFastestWithinAnErrorIsChosen)
{
    const std::vector<Row> rows{row(1, 100, 0), row(4, 30, 1.5), row(16, 10, 4)};
    EXPECT_EQ(choose(rows, {.frame_rate_hz = 30})->setting.max_cluster_size, 4);
    EXPECT_EQ(choose(rows, {.error = 4})->setting.max_cluster_size, 16);
    EXPECT_FALSE(choose(rows, {.frame_rate_hz = 200}));
}

} // namespace
} // namespace slod::cost
