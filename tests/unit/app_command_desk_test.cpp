#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "unit/command_desk_fixture.hpp"

namespace slod {
namespace {

using namespace std::chrono_literals;

TEST_F(Desk, AnAppliedRequestIsAnsweredWithItsFrameAndRevision)
{
    const Request adding = add("core");
    const Answer answer = ask(adding);
    EXPECT_EQ(answer.result, slod_v1_RESULT_APPLIED) << answer.text;
    EXPECT_EQ(answer.client, alice);
    EXPECT_EQ(answer.number, adding.number);
    EXPECT_EQ(answer.applied_frame, frame);
    EXPECT_EQ(answer.revision, desk.editor().find("core")->revision);
    EXPECT_EQ(simulation.regions().front().settings, *region("core"));
}

TEST_F(Desk, ARetryAppliesOnceAndIsAnsweredAlike)
{
    ask(request("pause"));
    Request step = request("step");
    step.frames = 1;
    const Answer first = ask(step);
    const Answer again = desk.handle(step, frame + 5, now);
    EXPECT_EQ(again.result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(again.applied_frame, first.applied_frame);
    desk.control().count_frame();
    EXPECT_FALSE(desk.control().may_run());
}

TEST_F(Desk, ARequestOlderThanTheRememberedOnesIsNotAppliedAgain)
{
    const Request adding = add("core");
    ask(adding);
    ask(request("remove_roi", "core"));
    for (std::uint64_t i = 0; i < AnswerMemory::answers_per_client; ++i)
        ask(request("keep_alive"));
    EXPECT_EQ(ask(adding).result, slod_v1_RESULT_LIMIT_REACHED);
    EXPECT_FALSE(region("core"));
}

// The desk remembers four clients.
TEST_F(Desk, AFifthClientIsRefusedUntilOneWasSilentForARequestsLife)
{
    const Request adding = add("core");
    ask(adding);
    ask(request("remove_roi", "core"));
    for (std::uint8_t other = 10; other < 13; ++other)
        ASSERT_EQ(ask(request("keep_alive", {}, {other})).result, slod_v1_RESULT_APPLIED);
    now += 10s;
    const Answer crowded = ask(request("keep_alive", {}, bob));
    EXPECT_EQ(crowded.result, slod_v1_RESULT_LIMIT_REACHED);
    EXPECT_EQ(crowded.field, "client");
    EXPECT_EQ(crowded.client, bob);
    EXPECT_EQ(crowded.number, number);
    EXPECT_EQ(ask(adding).result, slod_v1_RESULT_APPLIED) << "as it was answered before";
    EXPECT_FALSE(region("core"));
    now += 1s;
    EXPECT_EQ(ask(request("keep_alive", {}, bob)).result, slod_v1_RESULT_APPLIED);
}

TEST_F(Desk, AnUnknownKindIsAnsweredAsUnsupported)
{
    for (const char* kind : {"", "dance", "checkpoint", "PAUSE"})
        EXPECT_EQ(ask(request(kind)).result, slod_v1_RESULT_UNSUPPORTED) << kind;
}

// What is wrong, and the answer with the field to blame; the simulation's state keeps every bit.
TEST_F(Desk, ABadRequestIsRefusedAndChangesNothing)
{
    ask(add("core"));
    const std::uint64_t before = simulation.state_hash();
    const auto expect = [&](Request asked, wire::ResultCode result, const std::string& field) {
        SCOPED_TRACE(asked.kind + " " + asked.region);
        const Answer answer = ask(asked);
        EXPECT_EQ(answer.result, result) << answer.text;
        EXPECT_EQ(answer.field, field) << answer.text;
        EXPECT_EQ(answer.applied_frame, 0U);
        EXPECT_EQ(simulation.state_hash(), before);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    expect(add("core"), slod_v1_RESULT_REGION_EXISTS, "region");
    expect(add("No Name"), slod_v1_RESULT_INVALID, "region");
    expect(add("new", alice, nan), slod_v1_RESULT_INVALID, "lease_s");
    expect(add("new", alice, -1), slod_v1_RESULT_INVALID, "lease_s");
    expect(move("nowhere", {0, 0, 0}), slod_v1_RESULT_UNKNOWN_REGION, "region");
    expect(move("core", {nan, 0, 0}), slod_v1_RESULT_INVALID, "centre");
    expect(move("background", {1, 0, 0}), slod_v1_RESULT_INVALID, "region");
    expect(request("remove_roi", "background"), slod_v1_RESULT_NOT_PERMITTED, "region");
    expect(request("resize_roi", "background"), slod_v1_RESULT_INVALID, "region");
    expect(request("set_roi", "core"), slod_v1_RESULT_INVALID, "settings");
    expect(request("set"), slod_v1_RESULT_INVALID, "settings");
    expect(request("step"), slod_v1_RESULT_NOT_PERMITTED, "kind");
    const auto setting = [&](const std::string& kind, const std::string& region, Assignment assignment) {
        Request asked = request(kind, region);
        asked.settings = {std::move(assignment)};
        return asked;
    };
    expect(setting("set_roi", "core", {"name", "other"}), slod_v1_RESULT_INVALID, "name");
    expect(setting("set_roi", "core", {"pool_factor", "0"}), slod_v1_RESULT_INVALID, "pool_factor");
    expect(setting("set_roi", "background", {"shape", "box"}), slod_v1_RESULT_INVALID, "shape");
    expect(setting("set", "", {"time.step", "2"}), slod_v1_RESULT_INVALID, "time.step");
    expect(setting("set", "", {"gravity.strength", "-1"}), slod_v1_RESULT_INVALID, "gravity.strength");
    expect(setting("set", "", {"background.pool_factor", "0"}), slod_v1_RESULT_INVALID,
           "background.pool_factor");
}

TEST_F(Desk, SettingsOfTheSceneAndOfTheBackgroundAreSet)
{
    Request scene = request("set");
    scene.settings = {{"gravity.strength", "0.5"}};
    EXPECT_EQ(ask(scene).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(simulation.settings().gravity->strength, 0.5);
    Request background = request("set");
    background.settings = {{"background.max_cluster_size", "4"}, {"background.pool_factor", "2"}};
    EXPECT_EQ(ask(background).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("background")->partition.max_cluster_size, 4);
    Request mixed = request("set");
    mixed.settings = {{"gravity.strength", "0.25"}, {"background.max_cluster_size", "8"}};
    EXPECT_EQ(ask(mixed).result, slod_v1_RESULT_INVALID);
    EXPECT_EQ(simulation.settings().gravity->strength, 0.5);
}

// The scene has gravity, and neither of the uniform effects.
TEST_F(Desk, ASettingThatCannotChangeIsRefusedWithItsOwnReason)
{
    const auto expect = [&](const std::string& key, const std::string& text) {
        Request asked = request("set");
        asked.settings = {{key, "1"}};
        const Answer answer = ask(asked);
        EXPECT_EQ(answer.result, slod_v1_RESULT_INVALID) << key;
        EXPECT_NE(answer.text.find(text), std::string::npos) << answer.text;
        EXPECT_LE(answer.text.size(), 256U) << "the wire has no room for more: " << answer.text;
    };
    expect("gravty.strength", "gravty.strength is of no table; did you mean gravity?");
    for (const std::string table : {"galaxy.particles", "wire.commands", "motion.clock", "emitter.0.rate"})
        expect(table, table +
                          " cannot change while the scene runs; start the server with it. What can is in "
                          "alarms, background, control, effects, meter, server, or the table of an effect");
    expect("gravity", "write table.key");
    expect("region.0.max_cluster_size", "is set by the region's name: slodctl roi set");
    expect("nosuch.strength", "nosuch.strength is of no table. What can change is in alarms, background");
    expect("effects.gravty", "did you mean gravity?");
    expect("effects.vortex", "effects.vortex = 1 ");
}

TEST_F(Desk, EffectsAreSwitchedAndComeWhileTheSceneRuns)
{
    const auto set = [&](const std::string& key, const std::string& value) {
        Request asked = request("set");
        asked.settings = {{key, value}};
        return ask(asked);
    };
    EXPECT_EQ(set("effects.gravity", "false").result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(simulation.plan().effects[effect_row("gravity")].state(), "off");
    EXPECT_EQ(set("linear_drag.rate", "0.5").result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(set("attractor.0.strength", "0.5").result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(set("attractor.1.strength", "0.25").result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(simulation.settings().fields.of<Attractor>().size(), 2U);
    EXPECT_EQ(set("attractor.9.strength", "1").field, "attractor.9.strength");
    EXPECT_EQ(simulation.plan().effects[effect_row("linear_drag")].state(), "active");
    for (const char* value : {"true", "false"}) {
        const Answer refused = set("effects.vortex", value);
        EXPECT_EQ(refused.result, slod_v1_RESULT_INVALID);
        EXPECT_TRUE(refused.text.starts_with("effects.vortex switches what the scene does not have"))
            << refused.text;
    }
}

TEST_F(Desk, PauseStepAndResumeDecideWhichFramesRun)
{
    EXPECT_TRUE(desk.control().may_run());
    ask(request("pause"));
    EXPECT_FALSE(desk.control().may_run());
    Request step = request("step");
    step.frames = 2;
    ask(step);
    for (int i = 0; i < 2; ++i) {
        EXPECT_TRUE(desk.control().may_run());
        desk.control().count_frame();
    }
    EXPECT_FALSE(desk.control().may_run());
    ask(request("resume"));
    EXPECT_TRUE(desk.control().may_run());
    EXPECT_FALSE(desk.control().stopped());
    ask(request("stop"));
    EXPECT_TRUE(desk.control().stopped());
}

TEST_F(Desk, N11_WhatWasDoneCanBeRepeatedFromTheLog)
{
    ask(add("core"));
    ask(move("core", {0.5, 0, 0}));
    ask(add("own", alice, 5));
    Request scene = request("set");
    scene.settings = {{"gravity.strength", "0.5"}};
    ask(scene);
    ask(request("pause"));
    ask(request("remove_roi", "own"));
    const std::vector<LoggedCommand> log = desk.editor().take_log();
    EXPECT_EQ(log.size(), 5U) << "pause is not logged";

    Simulation again(settings(), cube(), {});
    SceneEditor editor(again);
    for (const LoggedCommand& command : log)
        EXPECT_EQ(editor.repeat(command), Problems{});
    again.step({});
    simulation.step({});
    EXPECT_EQ(again.state_hash(), simulation.state_hash());
    test::expect_at_most("repeats with another hash", again.state_hash() == simulation.state_hash() ? 0 : 1,
                         0);
    EXPECT_FALSE(
        editor.repeat({.frame = 20, .kind = InputKind::RemoveRegion, .region = "own", .settings = {}})
            .empty());
}

TEST_F(Desk, ARepeatedRunTakesNoChangesFromClients)
{
    CommandDesk reading(simulation, {.read_only = true});
    EXPECT_EQ(reading.handle(add("core"), frame, now).result, slod_v1_RESULT_NOT_PERMITTED);
    EXPECT_EQ(reading.handle(request("pause"), frame, now).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(simulation.regions().size(), 1U);
}

} // namespace
} // namespace slod
