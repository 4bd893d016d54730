#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "unit/command_desk_fixture.hpp"

namespace slod {
namespace {

using namespace std::chrono_literals;

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
    const Answer refused = ask(late);
    EXPECT_EQ(refused.result, slod_v1_RESULT_STALE_REVISION);
    EXPECT_TRUE(refused.text.starts_with("Region core is at revision " + std::to_string(moved.revision) +
                                         ", not " + std::to_string(added)))
        << refused.text;
    EXPECT_TRUE(ask(move("nosuch", {0, 0, 0})).text.starts_with("There is no region \"nosuch\"; "));
    EXPECT_TRUE(ask(add("no such")).text.starts_with("region = \"no such\" is no name; "));
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

TEST_F(Desk, NoMoreRegionsAreAddedThanTheBound)
{
    for (std::size_t i = 0; i < max_regions; ++i)
        ASSERT_EQ(ask(add("r" + std::to_string(i))).result, slod_v1_RESULT_APPLIED);
    EXPECT_EQ(ask(add("one-more")).result, slod_v1_RESULT_LIMIT_REACHED);
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

} // namespace
} // namespace slod
