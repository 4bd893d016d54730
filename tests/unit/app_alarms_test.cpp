#include <algorithm>
#include <string_view>

#include <gtest/gtest.h>

#include "app/alarms.hpp"
#include "scene/scene_check.hpp"
#include "support/small_scenes.hpp"

namespace slod::test {
namespace {

constexpr double step = 1.0 / 64;

/// A scene's frames, as alarms are told of them.
class AlarmsOfFrames : public testing::Test {
protected:
    AlarmsOfFrames() : alarms_({.conserved = {.mass = 1, .kinetic_energy = 0.5}, .potential_energy = -1}) {}

    /// Adds a frame of a hundred particles, changed by `change`.
    template <class Change>
    void frame(const Change& change)
    {
        Snapshot snapshot;
        snapshot.frame = ++frame_;
        snapshot.counts.particles = 100;
        change(snapshot);
        alarms_.add(snapshot, step);
    }

    const Alarm* look(std::string_view name)
    {
        news_ = alarms_.look(limits_, regulation_);
        const auto named = [&](const Alarm& alarm) { return alarm.name == name; };
        const auto found = std::find_if(alarms_.present().begin(), alarms_.present().end(), named);
        return found != alarms_.present().end() ? &*found : nullptr;
    }

    /// Looks at seconds of one quiet frame each until an alarm is gone; how many.
    int looks_until_gone(std::string_view name)
    {
        for (int looks = 1; looks < 100; ++looks) {
            frame([](Snapshot&) {});
            if (look(name) == nullptr)
                return looks;
        }
        return 100;
    }

    Alarms alarms_;
    AlarmSettings limits_;
    ControlReport regulation_;
    std::uint64_t frame_ = 0;
    bool news_ = false;
};

TEST_F(AlarmsOfFrames, AreNoneWhereNothingIsWrong)
{
    for (int i = 0; i < 30; ++i)
        frame([](Snapshot&) {});
    EXPECT_EQ(look("quarantined"), nullptr);
    EXPECT_TRUE(alarms_.present().empty());
    EXPECT_FALSE(news_);
}

TEST_F(AlarmsOfFrames, NameWhoWasTakenOutAndStay)
{
    frame([](Snapshot& now) {
        now.quarantined = {.particles = 2, .mass = 1, .first_ids = {17, 203}};
        now.counts.quarantined = 2;
    });
    const Alarm* alarm = look("quarantined");
    ASSERT_NE(alarm, nullptr);
    EXPECT_TRUE(news_);
    EXPECT_EQ(alarm->severity, AlarmSeverity::Error);
    EXPECT_EQ(alarm->occurrences, 2U);
    EXPECT_NE(alarm->text.find("17, 203"), std::string::npos) << alarm->text;
    EXPECT_EQ(looks_until_gone("quarantined"), 100);
    EXPECT_EQ(look("quarantined")->occurrences, 2U);
}

TEST_F(AlarmsOfFrames, CountUnderResolvedFramesAboveTheirShareAndGoAfterFiveQuietLooks)
{
    const auto second_with = [&](int flagged) {
        for (int i = 0; i < 20; ++i)
            frame([&](Snapshot& now) { now.counts.under_resolved = i < flagged ? 1 : 0; });
        return look("under_resolved");
    };
    EXPECT_EQ(second_with(2), nullptr); // a tenth, which is not too much
    ASSERT_NE(second_with(3), nullptr);
    EXPECT_EQ(second_with(20)->occurrences, 23U);
    EXPECT_EQ(look("under_resolved")->first_frame, 40U);
    EXPECT_EQ(looks_until_gone("under_resolved"), 4); // that look without a frame was the first
    EXPECT_TRUE(news_);
}

TEST_F(AlarmsOfFrames, WeighDriftsThatAreLimited)
{
    const auto drifted = [](Snapshot& now) {
        now.conserved = {.mass = 1, .momentum = {0.1, 0, 0}, .kinetic_energy = 0.6};
        now.potential_energy = -1;
    };
    frame(drifted);
    EXPECT_EQ(look("energy_drift"), nullptr);
    limits_.energy_drift = 0.21; // of the energy of -0.5, 0.1 is a fifth
    limits_.momentum_drift = 0.11;
    frame(drifted);
    EXPECT_EQ(look("energy_drift"), nullptr);
    limits_.energy_drift = 0.19;
    frame(drifted);
    EXPECT_NE(look("energy_drift"), nullptr);
    EXPECT_EQ(look("momentum_drift"), nullptr);
    limits_.momentum_drift = 0.09; // 0.1 of at most sqrt(2 * 1 * 0.5)
    EXPECT_NE(look("momentum_drift"), nullptr);
}

TEST_F(AlarmsOfFrames, SumUpWhatRegionsThatDoNotAttractOthersBringIn)
{
    limits_.dropped_momentum = 0.99;
    const auto unanswered = [](Snapshot& now) { now.unanswered_force = {1, 0, 0}; };
    for (int i = 0; i < 63; ++i)
        frame(unanswered);
    EXPECT_EQ(look("dropped_momentum"), nullptr);
    frame(unanswered); // a force of 1 over a unit of time
    EXPECT_NE(look("dropped_momentum"), nullptr);
}

// Whose scale at the start is none.
TEST(AlarmsOfASystemAtRest, KnowMomentumBesidesWhatMovesLater)
{
    const AlarmSettings limits{.energy_drift = 0.1, .momentum_drift = 0.1, .angular_momentum_drift = 0.1};
    Alarms alarms({.conserved = {.mass = 1}, .potential_energy = -1});
    EXPECT_EQ(alarms.unwatched(limits), std::vector<std::string_view>{"angular_momentum_drift"});
    Snapshot falling;
    falling.conserved = {.mass = 1, .momentum = {0.2, 0, 0}, .kinetic_energy = 0.5};
    falling.potential_energy = -1.5;
    alarms.add(falling, step);
    EXPECT_TRUE(alarms.look(limits, {}));
    ASSERT_EQ(alarms.present().size(), 1U); // 0.2 of a largest momentum of 1; the energy is what it was
    EXPECT_EQ(alarms.present().front().name, "momentum_drift");
}

TEST_F(AlarmsOfFrames, BeginAnewWhereEffectsHaveChanged)
{
    limits_.momentum_drift = 0.05;
    const ConservedQuantities pushed{.mass = 1, .momentum = {0.1, 0, 0}, .kinetic_energy = 0.5};
    frame([&](Snapshot& now) { now.conserved = pushed; });
    EXPECT_NE(look("momentum_drift"), nullptr);
    alarms_.begin_anew({.conserved = pushed});
    EXPECT_EQ(looks_until_gone("momentum_drift"), 5);
    ASSERT_EQ(alarms_.past().size(), 1U);
    EXPECT_EQ(alarms_.past().front().name, "momentum_drift");
}

TEST_F(AlarmsOfFrames, AtTheEndAreWeighedByWhatIsThen)
{
    limits_.momentum_drift = 0.05;
    alarms_.look_at_end({.conserved = {.mass = 1, .momentum = {0.1, 0, 0}, .kinetic_energy = 0.5}}, limits_,
                        {});
    ASSERT_EQ(alarms_.present().size(), 1U);
    EXPECT_EQ(alarms_.present().front().name, "momentum_drift");
}

TEST_F(AlarmsOfFrames, TellOfTheRest)
{
    limits_.reformed = 0.5;
    regulation_.state = ControlState::Unreachable;
    frame([](Snapshot& now) {
        now.counts.reformed_members = 60;
        now.counts.births_refused = 7;
        now.counts.impacts_cut_off = 3;
        now.counts.due_pools = 9;
        now.counts.worn_pools = 1;
    });
    EXPECT_NE(look("reformed"), nullptr);
    for (const char* name : {"births_refused", "impacts_cut_off", "unreachable", "worn_maps"})
        EXPECT_NE(look(name), nullptr) << name;
    EXPECT_EQ(alarms_.present().size(), 5U);
}

TEST(AlarmLimits, AreRefusedForWhatTheSceneDoesNotConserve)
{
    const AlarmSettings energy{.energy_drift = 0.1}, momentum{.momentum_drift = 0.1};
    SimulationSettings settings = quiet_settings();
    EXPECT_EQ(problems(energy, settings), Problems{});
    EXPECT_EQ(problems(momentum, settings), Problems{});
    settings.uniform_gravity.emplace();
    EXPECT_EQ(problems(energy, settings), Problems{});
    EXPECT_EQ(problems(momentum, settings).size(), 1U);
    settings.linear_drag.emplace();
    EXPECT_EQ(problems(energy, settings).size(), 1U);
    settings.effects.on[effect_row("linear_drag")] = false;
    EXPECT_EQ(problems(energy, settings), Problems{});
    settings.gravity.emplace(); // of clusters
    EXPECT_EQ(problems(energy, settings).size(), 1U);
    settings.background.max_cluster_size = 1;
    EXPECT_EQ(problems(energy, settings), Problems{});
    RegionOfInterest region;
    region.name = "core";
    region.partition.max_cluster_size = 8;
    settings.regions = {region};
    EXPECT_EQ(problems(energy, settings).size(), 1U);
    settings.uniform_gravity.reset();
    settings.linear_drag.reset();
    EXPECT_EQ(problems(momentum, settings), Problems{});
    settings.regions.front().partition.attracts = Attracts::Nothing;
    EXPECT_EQ(problems(momentum, settings).size(), 1U);
}

} // namespace
} // namespace slod::test
