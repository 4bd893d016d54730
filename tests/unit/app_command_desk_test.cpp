#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/command_desk.hpp"
#include "core/parallel.hpp"

// The desk over a simulation of eight particles.
namespace slod {
namespace {

using namespace std::chrono_literals;

constexpr wire::Uuid alice{1}, bob{2};
constexpr std::uint64_t frame = 12;

SimulationSettings settings()
{
    SimulationSettings scene;
    scene.kinds.push_back({.name = "dust", .softening = 0.1});
    scene.gravity.emplace();
    scene.background.max_breadth = 1;
    return scene;
}

ParticleSet cube()
{
    ParticleSet particles;
    for (std::uint64_t id = 0; id < 8; ++id)
        particles.push_back({.position = {double(id & 1), double(id >> 1 & 1), double(id >> 2)},
                             .velocity = {0, 0, 0},
                             .id = id,
                             .mass = 1});
    return particles;
}

class Desk : public testing::Test {
protected:
    Answer ask(const Request& request) { return desk.handle(request, frame, now); }

    /// A new request of a client.
    Request request(const std::string& kind, const std::string& region = {}, const wire::Uuid& client = alice)
    {
        return {.client = client, .number = ++number, .kind = kind, .region = region};
    }

    Request add(const std::string& region, const wire::Uuid& client = alice, double lease_s = 0)
    {
        Request adding = request("add_roi", region, client);
        adding.half_extent = {1, 1, 1};
        adding.lease_s = lease_s;
        adding.settings = {{"shape", "box"}};
        return adding;
    }

    Request move(const std::string& region, const Vector3d& centre, const wire::Uuid& client = alice)
    {
        Request moving = request("move_roi", region, client);
        moving.centre = centre;
        return moving;
    }

    /// One view before the next frame.
    void show(const ClientView& view)
    {
        desk.see(view, now);
        desk.follow_views(frame);
    }

    const RegionOfInterest* region(const std::string& name)
    {
        const RegionRecord* const record = desk.editor().find(name);
        return record ? &record->settings : nullptr;
    }

    ThreadTeam team{1};
    Simulation simulation{settings(), cube(), {}};
    CommandDesk desk{simulation, {.max_clients = 4}};
    CommandDesk::Clock::time_point now{1h};
    std::uint64_t number = 0;
};

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

TEST_F(Desk, MoveResizeSetAndRemoveChangeTheRegion)
{
    ask(add("core"));
    EXPECT_EQ(ask(move("core", {1, 2, 3})).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("core")->centre, Vector3d(1, 2, 3));
    Request resize = request("resize_roi", "core");
    resize.half_extent = {4, 5, 6};
    EXPECT_EQ(ask(resize).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("core")->half_extent, Vector3d(4, 5, 6));
    Request set = request("set_roi", "core");
    set.settings = {{"max_cluster_size", "4"}, {"shape", "sphere"}, {"radius", "2"}};
    EXPECT_EQ(ask(set).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("core")->partition.max_cluster_size, 4);
    Request resize_sphere = request("resize_roi", "core");
    resize_sphere.radius = 7;
    EXPECT_EQ(ask(resize_sphere).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("core")->radius, 7);
    EXPECT_EQ(ask(request("remove_roi", "core")).revision, 0U);
    EXPECT_FALSE(region("core"));
    EXPECT_EQ(simulation.regions().size(), 1U);
}

TEST_F(Desk, ANewRegionKeepsTheSizesThatAreNotSaid)
{
    Request adding = request("add_roi", "sphere");
    adding.radius = 2;
    adding.settings = {{"shape", "sphere"}};
    ASSERT_EQ(ask(adding).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("sphere")->radius, 2);
    EXPECT_EQ(region("sphere")->half_extent, RegionOfInterest().half_extent);
    adding = request("add_roi", "box");
    adding.settings = {{"shape", "box"}};
    ASSERT_EQ(ask(adding).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(region("box")->half_extent, RegionOfInterest().half_extent);
    EXPECT_EQ(region("box")->radius, RegionOfInterest().radius);
}

TEST_F(Desk, ANewRegionThatSaysNotWhatItHoldsIsRefused)
{
    const auto refused = [&](const Vector3d& centre, double radius, std::vector<Assignment> settings) {
        Request adding = request("add_roi", "new" + std::to_string(number));
        adding.centre = centre;
        adding.radius = radius;
        adding.settings = std::move(settings);
        const Answer answer = ask(adding);
        EXPECT_TRUE(answer.result == slod_v1_RESULT_APPLIED || answer.field == "shape") << answer.text;
        return answer.result != slod_v1_RESULT_APPLIED;
    };
    EXPECT_TRUE(refused({0, 0, 0}, 0, {}));
    EXPECT_TRUE(refused({0, 0, 0}, 0, {{"max_cluster_size", "4"}}));
    EXPECT_TRUE(refused({1, 0, 0}, 0, {{"least_speed", "1"}}));
    EXPECT_TRUE(refused({0, 0, 0}, 1, {}));
    EXPECT_FALSE(refused({0, 0, 0}, 0, {{"shape", "everywhere"}}));
    EXPECT_FALSE(refused({0, 0, 0}, 0, {{"least_speed", "1"}}));
}

// Neither leaves the region what it was, nor makes one that holds nothing.
TEST_F(Desk, ARegionIsResizedByTheSizeOfItsShapeAlone)
{
    ask(add("box"));
    Request add_sphere = request("add_roi", "sphere");
    add_sphere.radius = 1;
    add_sphere.settings = {{"shape", "sphere"}};
    ask(add_sphere);
    const auto refused_field = [&](const char* name, const Vector3d& half_extent, double radius) {
        Request resize = request("resize_roi", name);
        resize.half_extent = half_extent;
        resize.radius = radius;
        const Answer answer = ask(resize);
        EXPECT_EQ(answer.result, slod_v1_RESULT_INVALID);
        return answer.field;
    };
    EXPECT_EQ(refused_field("box", {0, 0, 0}, 2), "radius");
    EXPECT_EQ(refused_field("box", {2, 2, 2}, 2), "radius");
    EXPECT_EQ(refused_field("box", {0, 0, 0}, 0), "half_extent");
    EXPECT_EQ(refused_field("box", {2, 0, 2}, 0), "half_extent");
    EXPECT_EQ(refused_field("sphere", {2, 2, 2}, 0), "half_extent");
    EXPECT_EQ(refused_field("sphere", {2, 2, 2}, 2), "half_extent");
    EXPECT_EQ(refused_field("sphere", {0, 0, 0}, 0), "radius");
    EXPECT_EQ(region("box")->half_extent, Vector3d(1, 1, 1));
    EXPECT_EQ(region("sphere")->radius, 1);
}

TEST_F(Desk, AStaleRevisionIsRefused)
{
    const std::uint64_t added = ask(add("core")).revision;
    Request moving = move("core", {1, 0, 0});
    moving.if_revision = added;
    const Answer moved = ask(moving);
    EXPECT_EQ(moved.result, slod_v1_RESULT_APPLIED);
    EXPECT_GT(moved.revision, added);
    Request late = move("core", {2, 0, 0}, bob);
    late.if_revision = added;
    EXPECT_EQ(ask(late).result, slod_v1_RESULT_STALE_REVISION);
    EXPECT_EQ(region("core")->centre, Vector3d(1, 0, 0));
}

TEST_F(Desk, TheBackgroundsRevisionIsHonouredAndAnsweredHoweverItIsSet)
{
    Request set = request("set");
    set.settings = {{"background.max_cluster_size", "4"}};
    const Answer first = ask(set);
    EXPECT_EQ(first.revision, desk.editor().find("background")->revision);
    set.number = ++number;
    set.settings = {{"background.max_cluster_size", "8"}};
    set.if_revision = first.revision - 1;
    EXPECT_EQ(ask(set).result, slod_v1_RESULT_STALE_REVISION);
    EXPECT_EQ(region("background")->partition.max_cluster_size, 4);
    set.number = ++number;
    set.if_revision = first.revision;
    EXPECT_GT(ask(set).revision, first.revision);
}

TEST_F(Desk, ARevisionIsRefusedWhereNothingHasOne)
{
    Request set = request("set");
    set.settings = {{"gravity.strength", "0.5"}};
    for (Request asked : {add("core"), request("pause"), request("keep_alive"), set}) {
        asked.if_revision = 1;
        const Answer answer = ask(asked);
        EXPECT_EQ(answer.result, slod_v1_RESULT_INVALID) << asked.kind;
        EXPECT_EQ(answer.field, "if_revision") << asked.kind;
    }
    EXPECT_FALSE(desk.control().paused());
    EXPECT_FALSE(region("core"));
}

TEST_F(Desk, ARevisionNeverComesAgainUnderTheSameName)
{
    const std::uint64_t first = ask(add("core")).revision;
    ask(request("remove_roi", "core"));
    EXPECT_GT(ask(add("core")).revision, first);
}

TEST_F(Desk, OnlyItsOwnerChangesALeasedRegion)
{
    ask(add("own", alice, 10));
    ask(add("common", alice));
    EXPECT_EQ(ask(move("own", {1, 0, 0}, bob)).result, slod_v1_RESULT_NOT_OWNER);
    EXPECT_EQ(ask(request("remove_roi", "own", bob)).result, slod_v1_RESULT_NOT_OWNER);
    EXPECT_EQ(ask(move("own", {1, 0, 0}, alice)).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(ask(move("common", {1, 0, 0}, bob)).result, slod_v1_RESULT_APPLIED);
}

TEST_F(Desk, ALeasedRegionGoesWhenItsOwnerIsSilentForSoLong)
{
    ask(add("own", alice, 10));
    now += 9s;
    ask(request("keep_alive"));
    now += 9s;
    ask(request("keep_alive", {}, bob));
    desk.expire_leases(frame, now);
    EXPECT_TRUE(region("own"));
    now += 2s;
    desk.editor().take_log();
    desk.expire_leases(frame + 1, now);
    EXPECT_FALSE(region("own"));
    const std::vector<LoggedCommand> log = desk.editor().take_log();
    ASSERT_EQ(log.size(), 1U);
    EXPECT_EQ(log[0].kind, InputKind::RemoveRegion);
    EXPECT_EQ(log[0].frame, frame + 1);
    EXPECT_TRUE(desk.editor().take_news().back().removed);
}

// The name is free again, and the old lease does not end the new region.
TEST_F(Desk, ALeaseEndsWithItsRegion)
{
    ask(add("own", alice, 10));
    ask(request("remove_roi", "own"));
    ask(add("own"));
    desk.expire_leases(frame, now + 11s);
    EXPECT_TRUE(region("own"));
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
    expect(setting("set", "", {"time.step", "2"}), slod_v1_RESULT_INVALID, "time");
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

TEST_F(Desk, NoMoreRegionsAreAddedThanTheBound)
{
    for (std::size_t i = 0; i < max_regions; ++i)
        ASSERT_EQ(ask(add("r" + std::to_string(i))).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(ask(add("one-more")).result, slod_v1_RESULT_LIMIT_REACHED);
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

TEST_F(Desk, AViewMovesTheFrustumsThatFollowItsClient)
{
    for (const auto& [name, share] : {std::pair("centre", "0.25"), std::pair("periphery", "1")}) {
        Request adding = request("add_roi", name);
        adding.settings = {{"shape", "frustum"}, {"follows", "desk"}, {"view_share", share}, {"far", "100"}};
        ASSERT_EQ(ask(adding).result, slod_v1_RESULT_APPLIED);
    }
    ask(add("box"));
    const ClientView view{.client = bob,
                          .client_name = "desk",
                          .eye = {1, 2, 3},
                          .look_at = {1, 2, -3},
                          .up = {1, 0, 0},
                          .field_of_view_deg = 40,
                          .aspect = 2};
    show(view);
    EXPECT_EQ(region("centre")->centre, view.eye);
    EXPECT_EQ(region("centre")->direction, Vector3d(0, 0, -6));
    EXPECT_EQ(region("centre")->up, view.up);
    EXPECT_EQ(region("centre")->field_of_view_deg, 10);
    EXPECT_EQ(region("centre")->far_distance, 100);
    EXPECT_EQ(region("periphery")->field_of_view_deg, 40);
    EXPECT_EQ(region("periphery")->aspect, 2);
    EXPECT_EQ(region("box")->centre, Vector3d(0, 0, 0));

    desk.editor().take_log();
    show(view);
    EXPECT_TRUE(desk.editor().take_log().empty()) << "nothing moved";
    ClientView other = view;
    other.client_name = "another";
    other.eye.x() = 9;
    ClientView blind = view;
    blind.look_at = blind.eye;
    ClientView broken = view;
    broken.field_of_view_deg = std::numeric_limits<double>::quiet_NaN();
    for (const ClientView& useless : {other, blind, broken})
        show(useless);
    EXPECT_TRUE(desk.editor().take_log().empty());
}

TEST_F(Desk, OfAClientsViewsTheNewestMovesTheFrustumOnceAFrame)
{
    Request adding = request("add_roi", "seen");
    adding.settings = {{"shape", "frustum"}, {"follows", "desk"}};
    ask(adding);
    desk.editor().take_log();
    ClientView view{.client = bob, .client_name = "desk"};
    for (int i = 1; i <= 5; ++i) {
        view.eye.y() = i;
        desk.see(view, now);
    }
    EXPECT_TRUE(desk.editor().take_log().empty()) << "no frame is to run yet";
    desk.follow_views(frame);
    EXPECT_EQ(desk.editor().take_log().size(), 1U);
    EXPECT_EQ(region("seen")->centre.y(), 5);
    Request away = move("seen", {9, 9, 9});
    ask(away);
    desk.follow_views(frame + 1);
    EXPECT_EQ(region("seen")->centre, Vector3d(9, 9, 9)) << "a view moves nothing twice";
}

TEST_F(Desk, WhatWasDoneCanBeRepeatedFromTheLog)
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
