#include "scene_support.hpp"

#include <algorithm>

#include "scene/sections.hpp"
#include "scene/value_text.hpp"
#include "support/case_rows.hpp"
#include "support/field_tables.hpp"
#include "support/settings_keys.hpp"

namespace slod::test {

namespace {

const std::string two_of_each = minimal_scene + "[[kind]]\nname = \"dust\"\n"
                                                "[[emitter]]\nname = \"a\"\nkind = \"star\"\n"
                                                "[[emitter]]\nname = \"b\"\nkind = \"dust\"\n"
                                                "[[collider]]\nname = \"floor\"\n"
                                                "[[collider]]\nname = \"ball\"\nshape = \"sphere\"\n";

TEST(SceneOverride, ReplacesWhatTheFileSays)
{
    const Scene scene = scene_of("title = \"old\"\n" + minimal_scene + "[time]\nstep = 1\n",
                                 {"time.step=0.5", "title=\"new\"", "seed=7"});
    EXPECT_EQ(scene.simulation.time.step, 0.5);
    EXPECT_EQ(scene.title, "new");
    EXPECT_EQ(scene.simulation.seed, 7U);
}

TEST(SceneOverride, TheLastOfAKeyHolds)
{
    EXPECT_EQ(scene_of(minimal_scene, {"seed=7", "seed=8"}).simulation.seed, 8U);
}

TEST(SceneOverride, LeavesTheRestOfItsTableAlone)
{
    const Scene scene = scene_of(minimal_scene + "[motion]\nclock = 0.5\n", {"motion.longest_life=128"});
    EXPECT_EQ(scene.simulation.motion.clock, 0.5);
    EXPECT_EQ(scene.simulation.motion.longest_life, 128U);
}

TEST(SceneOverride, ReachesOneElementOfAnArray)
{
    const Scene scene =
        scene_of(two_of_each, {"emitter.0.rate=5", "emitter.1.rate=6", "kind.1.softening=0.25"});
    EXPECT_EQ(scene.simulation.emitters.at(0).rate, 5);
    EXPECT_EQ(scene.simulation.emitters.at(1).rate, 6);
    EXPECT_EQ(scene.simulation.kinds.at(0).softening, 0);
    EXPECT_EQ(scene.simulation.kinds.at(1).softening, 0.25);
}

TEST(SceneOverride, SwitchesAnAbsentEffectOn)
{
    const Scene scene = scene_of(minimal_scene, {"gravity.precision=double", "gravity.closure=false"});
    ASSERT_TRUE(scene.simulation.gravity);
    EXPECT_EQ(scene.simulation.gravity->precision, Precision::Double);
    EXPECT_FALSE(scene.simulation.gravity->closure);
}

TEST(SceneOverride, ABareWordIsAString)
{
    const Scene scene =
        scene_of(minimal_scene, {"motion.kind=rigid", "title=Stars, a \"few\" \\ # all of them",
                                 "initial.file=/data/some file.gadget2"});
    EXPECT_EQ(scene.simulation.motion.motion, Motion::Rigid);
    EXPECT_EQ(scene.title, "Stars, a \"few\" \\ # all of them");
    EXPECT_EQ(scene.initial.file, "/data/some file.gadget2");
}

TEST(SceneOverride, AnEmptyValueIsTheEmptyString)
{
    EXPECT_EQ(scene_of("title = \"old\"\n" + minimal_scene, {"title="}).title, "");
}

TEST(SceneOverride, ALineBreakCannotSmuggleInAnotherKey)
{
    const Scene scene = scene_of(minimal_scene, {"title=1\nseed=9"});
    EXPECT_EQ(scene.title, "1\nseed=9");
    EXPECT_EQ(scene.simulation.seed, SimulationSettings{}.seed);
}

TEST(SceneOverride, EveryKeyCanBeReached)
{
    Scene every = scene_of(two_of_each);
    name_all(every.simulation);
    // Each key is set to the value it has anyway: the only thing that could go wrong is not to find it.
    std::vector<std::string> overrides;
    for_each_key(every, [&](const std::string& key, const Field&, const auto& value) {
        overrides.push_back(key + "=" + value_text(value));
    });
    EXPECT_EQ(to_toml(scene_of(two_of_each, overrides)), to_toml(every));
}

TEST(SceneOverride, N01_NoKeyTakesWhatIsNoNumber)
{
    Scene every = scene_of(two_of_each + "[[region]]\nname = \"r\"\n[[sink]]\nname = \"s\"\n");
    name_all(every.simulation);
    ForceFields::for_each(
        [&]<class F> { add_element(every.simulation.fields.of<F>(), typename F::Settings{}); });
    AirFields::for_each(
        [&]<class F> { add_element(every.simulation.fields.of<F>(), typename F::Settings{}); });
    const std::string whole = to_toml(every);
    ASSERT_EQ(problems_of(whole), Problems{});
    std::size_t keys = 0, tried = 0, taken = 0;
    for_each_key(every, [&](const std::string& key, const Field& field, const auto& value) {
        const std::vector<std::string> bad = no_numbers(field, value);
        keys += bad.empty() ? 0 : 1;
        for (const std::string& text : bad) {
            const auto loaded = load_scene({.name = "s.toml", .text = whole}, {key + "=" + text});
            const auto* const found = std::get_if<Problems>(&loaded);
            const bool told = found != nullptr &&
                              std::any_of(found->begin(), found->end(), [&](const std::string& problem) {
                                  return problem.find(key + " = ") != std::string::npos;
                              });
            EXPECT_TRUE(told) << key << " = " << text;
            ++tried;
            taken += told ? 0 : 1;
        }
    });
    expect_at_least("keys of numbers", double(keys), 150);
    report_value("values tried", double(tried));
    expect_at_most("values taken that are no numbers", double(taken), 0);
}

TEST(SceneOverride, ItsProblemsNameTheOverrideInsteadOfALine)
{
    const auto faulty = [](const std::string& text) { return problems_of(two_of_each, {text}); };
    EXPECT_TRUE(only_says(faulty("time.step=-1"), {"--set time.step=-1: time.step = -1 is out of range"}));
    EXPECT_TRUE(
        only_says(faulty("gravity.precision=dubble"), {"--set gravity.precision=dubble: ", "mean double?"}));
    EXPECT_TRUE(only_says(faulty("emitter.1.rat=1"), {"--set emitter.1.rat=1: ", "did you mean rate?"}));
    EXPECT_TRUE(
        only_says(faulty("gravty.closure=true"), {"--set gravty.closure=true: [gravty]", "gravity?"}));
    EXPECT_TRUE(
        only_says(faulty("emitter.0.kind=water"), {"--set emitter.0.kind=water: emitter.0.kind", "no kind"}));
}

// A ring needs a radius, and a schedule has no rate beside it: what is wrong then is a key of the file, or
// none.
TEST(SceneOverride, WhatItMakesWrongElsewhereIsOwedToIt)
{
    const std::string scene = two_of_each + "[[emitter]]\nname = \"c\"\nkind = \"star\"\nrate = 5\n";
    EXPECT_TRUE(
        only_says(problems_of(scene, {"seed=2", "emitter.1.shape=ring"}),
                  {"--set emitter.1.shape=ring, beside ", "s.toml:10: emitter.1.radius = 0 is that"}));
    EXPECT_TRUE(
        only_says(problems_of(scene, {"emitter.2.schedule=[[0, 1]]", "emitter.0.rate=2"}),
                  {"--set emitter.2.schedule=[[0, 1]], beside ", "s.toml:21: emitter.2.rate = 5 is"}));
    const Problems both = problems_of(scene + "speed = -1\n", {"emitter.1.shape=ring"});
    EXPECT_EQ(both.size(), 2U);
    EXPECT_TRUE(one_says(both, {"emitter.2.speed = -1 is out of range"}));
    EXPECT_FALSE(one_says(both, {"--set", "emitter.2.speed"})) << "the file alone is to blame";
}

TEST(SceneOverride, AnElementThatIsNotThereIsRefused)
{
    const auto faulty = [](const std::string& text) { return problems_of(two_of_each, {text}); };
    EXPECT_TRUE(only_says(faulty("emitter.2.rate=1"),
                          {"--set emitter.2.rate=1: there is no [[emitter]] number 2", "2,"}));
    EXPECT_TRUE(
        only_says(faulty("emiter.0.rate=1"),
                  {"--set emiter.0.rate=1: [[emiter]] is no table of a scene; did you mean emitter?"}));
    EXPECT_TRUE(only_says(faulty("emitter.x.rate=1"), {"there is no [[emitter]] number x"}));
    EXPECT_TRUE(
        only_says(faulty("emitter.99999999999999999999.rate=1"), {"there is no [[emitter]] number 9999"}));
    EXPECT_TRUE(only_says(faulty("emitter.rate=1"),
                          {"--set emitter.rate=1: ", "write emitter.0.rate for the first"}));
    EXPECT_TRUE(only_says(faulty("time.0.step=1"), {"there is no [[time]] number 0"}));
    EXPECT_TRUE(
        only_says(problems_of("title = \"t\"\n" + two_of_each, {"title.x=1"}), {"title is no table"}));
}

TEST(SceneOverride, WhatIsNoAssignmentIsRefused)
{
    for (const std::string text :
         {"", "=", "time.step", "time..step=1", ".step=1", "time.=1", "a.b.c.d=1", "a b=1"})
        EXPECT_TRUE(only_says(problems_of(two_of_each, {text}),
                              {"--set " + text + ": not understood; write table.key="}));
}

TEST(SceneOverride, AValueMeantAsTomlButBrokenIsRefused)
{
    const auto faulty = [](const std::string& text) { return problems_of(two_of_each, {text}); };
    EXPECT_TRUE(only_says(faulty("emitter.0.position=[1,2"),
                          {"--set emitter.0.position=[1,2: the value is not TOML"}));
    EXPECT_TRUE(only_says(faulty("title=\"open"), {"--set title=\"open: the value is not TOML"}));
    EXPECT_TRUE(only_says(faulty("title=\xff"), {"the value is not TOML"}));
}

} // namespace

} // namespace slod::test
