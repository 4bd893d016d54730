#include <algorithm>
#include <atomic>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/sim_plan_scenes.hpp"

// What a scene comes down to: nothing runs and nothing is kept that the scene does not call for.
namespace slod::test {
namespace {

const Names all_effects = every_effect();

class PlanOf : public testing::TestWithParam<PlannedScene> {
protected:
    PlanOf()
    {
        for (std::uint64_t id = 0; id < 4; ++id)
            scene_.initial.push_back({{double(id), 0, 0}, {0, 0, 0}, id, 1});
        GetParam().choose(scene_);
    }

    Plan plan() const { return compile_plan(scene_.settings, scene_.initial); }

    SmallScene scene_{GetParam().name, quiet_settings(), {}};
};

Names names_of(const std::vector<PlannedColumn>& columns, std::size_t first)
{
    Names names;
    for (std::size_t i = first; i < columns.size(); ++i)
        names.emplace_back(columns[i].name);
    return names;
}

/// Names in the section of a text that begins with a line `title`, whose entry is `entry`.
Names listed(const std::string& text, const std::string& title, const std::string& entry)
{
    std::istringstream lines(text.substr(text.find("\n" + title + "\n") + title.size() + 2));
    Names names;
    for (std::string line; std::getline(lines, line) && !line.empty();)
        if (line.ends_with(' ' + entry))
            names.push_back(line.substr(2, line.find(' ', 2) - 2));
    return names;
}

TEST_P(PlanOf, HasThePhasesTheSceneCallsFor)
{
    Names phases;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (plan().runs[phase])
            phases.emplace_back(names(Phase{})[phase]);
    EXPECT_EQ(phases, GetParam().phases);
}

// A clock that advances by a millisecond at each look shows which phases are entered.
TEST_P(PlanOf, IsWhatRuns)
{
    std::atomic<std::int64_t> now{0}; // fields look from all threads
    Simulation simulation(scene_.settings, scene_.initial,
                          {.isa = {}, .tick = [&] { return now += 1'000'000; }});
    const StepProfile profile = simulation.step({}).profile;
    Names entered;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (profile.milliseconds[phase] > 0)
            entered.emplace_back(names(Phase{})[phase]);
    EXPECT_EQ(entered, GetParam().phases);
}

TEST_P(PlanOf, KnowsAllEffectsAndReportsTheAbsentOnes)
{
    Names known, active;
    for (const PlannedEffect& effect : plan().effects) {
        known.emplace_back(effect.name);
        if (effect.active)
            active.emplace_back(effect.name);
    }
    EXPECT_EQ(known, all_effects);
    EXPECT_EQ(active, GetParam().effects);
}

TEST_P(PlanOf, HasTheMapAndTheUpdateOfItsMotion)
{
    EXPECT_EQ(plan().map, GetParam().map);
    EXPECT_EQ(plan().map_is_exact, GetParam().exact);
    EXPECT_EQ(plan().clocked, GetParam().clocked);
    EXPECT_EQ(plan().merging, GetParam().merging);
}

TEST_P(PlanOf, HasTheColumnsTheSceneCallsFor)
{
    constexpr std::size_t always_of_members = 2, always_of_clusters = 5;
    EXPECT_EQ(names_of(plan().member_columns, always_of_members), GetParam().member_columns);
    EXPECT_EQ(names_of(plan().cluster_columns, always_of_clusters), GetParam().cluster_columns);
}

TEST_P(PlanOf, IsExplainedInWords)
{
    const std::string text = explain(plan(), scene_.settings);
    EXPECT_EQ(listed(text, "phases", "runs"), GetParam().phases) << text;
    Names absent;
    for (const std::string& effect : all_effects)
        if (std::find(GetParam().effects.begin(), GetParam().effects.end(), effect) ==
            GetParam().effects.end())
            absent.push_back(effect);
    EXPECT_EQ(listed(text, "effects", "absent"), absent) << text;
    for (const std::string& column : GetParam().cluster_columns)
        EXPECT_NE(text.find("  " + column + " "), std::string::npos) << column << " in\n" << text;
    const std::string map = "flow map " + std::string(names(MapKind{})[std::size_t(GetParam().map)]);
    EXPECT_NE(text.find(map + (GetParam().exact ? ", exact" : "\n")), std::string::npos) << map << " in\n"
                                                                                         << text;
}

std::string name_of(const testing::TestParamInfo<PlannedScene>& info)
{
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Motion, PlanOf, testing::ValuesIn(scenes_of_motion()), name_of);
INSTANTIATE_TEST_SUITE_P(Fields, PlanOf, testing::ValuesIn(scenes_of_fields()), name_of);
INSTANTIATE_TEST_SUITE_P(Particles, PlanOf, testing::ValuesIn(scenes_of_particles()), name_of);

// 24 bytes of offsets and 8 of id are all that a particle of the plainest scene takes.
TEST(PlainestPlan, KeepsThirtyTwoBytesPerParticle)
{
    std::size_t bytes = 0;
    for (const PlannedColumn& column : compile_plan(quiet_settings(), {}).member_columns)
        bytes += column.bytes;
    EXPECT_EQ(bytes, 32U);
}

TEST(Plan, ExplainsWhatWasChosenForAnAccuracy)
{
    SmallScene scene = small_scene("flow");
    ASSERT_TRUE(scene.settings.gravity.has_value());
    scene.settings.gravity = GravitySettings{.accuracy = 7.3e-4}; // of the calibration at 1e-3
    const std::string text = explain(compile_plan(scene.settings, scene.initial), scene.settings);
    EXPECT_NE(text.find("gravity  relative opening, quadrupole, force_tolerance 0.00"), std::string::npos)
        << text;
    EXPECT_NE(text.find(", for accuracy 0.00073\n"), std::string::npos) << text;
    scene.settings.gravity.reset();
    EXPECT_EQ(explain(compile_plan(scene.settings, scene.initial), scene.settings).find("gravity  relative"),
              std::string::npos);
}

} // namespace
} // namespace slod::test
