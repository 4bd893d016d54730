#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "view/region_editor.hpp"

namespace slod::view {
namespace {

using namespace std::chrono_literals;
using Clock = RegionEditor::Clock;
using Phase = RegionEditor::Phase;

constexpr Viewport picture{.width = 800, .height = 600};
const Clock::time_point start{1h};

/// Looks along +y at the origin from a distance of 10: x to the right, z up.
Lens front()
{
    return Lens(seen_from(Camera{}, AxisView::Front), picture);
}

client::RegionInfo box(std::uint64_t revision, const Vector& centre = {0, 0, 0})
{
    client::RegionInfo region;
    region.region = "core";
    region.revision = revision;
    region.shape = "box";
    region.centre = {centre.x(), centre.y(), centre.z()};
    region.half_extent = {1, 1, 1};
    return region;
}

/// An editor that knows one box, and what it sent.
class ViewerEditor : public testing::Test {
protected:
    ViewerEditor() { editor.on_regions({{"core", box(1)}}); }

    void grip(const Handle& handle, const Pixel& pixel = {400, 300})
    {
        editor.begin({"core", handle}, pixel);
    }

    /// Takes the command that is due, and sends it.
    std::optional<client::CommandRequest> send(Clock::time_point now)
    {
        auto command = editor.next_command(now);
        if (command)
            editor.sent(command->region, ++number);
        return command;
    }

    /// Answers the command that was sent last.
    void answer(std::uint64_t revision, wire::ResultCode result = slod_v1_RESULT_APPLIED)
    {
        client::CommandAnswer reply;
        reply.result = result;
        reply.revision = revision;
        EXPECT_TRUE(editor.on_answer(number, reply));
    }

    RegionEditor editor;
    std::uint64_t number = 0;
    const Handle middle{};
};

TEST_F(ViewerEditor, TheHandleUnderTheCursorIsFound)
{
    const Lens lens = front();
    const Pixel right_face = *lens.project({1, 0, 0});
    const auto found = editor.grip_at(lens, {right_face.x + 5, right_face.y - 5});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->region, "core");
    EXPECT_EQ(found->handle, (Handle{.axis = 0, .side = 1}));
    EXPECT_FALSE(editor.grip_at(lens, {right_face.x + 50, right_face.y}));
}

// Seen from the front both faces along y are where the middle is.
TEST_F(ViewerEditor, AFaceThatIsSeenEndOnDoesNotHideTheMiddle)
{
    const auto found = editor.grip_at(front(), {400, 300});
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->handle.is_centre());
    EXPECT_FALSE(can_be_dragged({.axis = 1, .side = 1}, *pose_of(box(1)), front()));
}

TEST_F(ViewerEditor, ADraggedRegionFollowsTheCursorAtOnce)
{
    grip(middle);
    editor.drag(front(), {500, 250});
    ASSERT_NE(editor.echo("core"), nullptr);
    const Pixel now_at = *front().project(editor.echo("core")->centre);
    EXPECT_NEAR(now_at.x, 500, 1e-9) << "rounding of doubles of some hundred";
    EXPECT_NEAR(now_at.y, 250, 1e-9);
    EXPECT_EQ(editor.phase("core"), Phase::Dragged);
}

TEST_F(ViewerEditor, AFaceMovesWhileTheOppositeOneRests)
{
    const Lens lens = front();
    const Pixel from = *lens.project({1, 0, 0}), to = *lens.project({2, 0, 0});
    grip({.axis = 0, .side = 1}, from);
    editor.drag(lens, to);
    const RegionPose& pose = *editor.echo("core");
    EXPECT_NEAR(pose.centre.x() - pose.half_extent.x(), -1, 1e-9);
    EXPECT_NEAR(pose.centre.x() + pose.half_extent.x(), 2, 1e-9);
    EXPECT_EQ(pose.half_extent.y(), 1);
    const auto command = send(start);
    ASSERT_TRUE(command);
    EXPECT_EQ(command->kind, "set_roi")
        << "place and size in one command, for no frame has one without the other";
}

TEST_F(ViewerEditor, ABoxIsNeverTurnedInsideOut)
{
    const Lens lens = front();
    grip({.axis = 0, .side = 1}, *lens.project({1, 0, 0}));
    editor.drag(lens, *lens.project({-3, 0, 0}));
    EXPECT_GT(editor.echo("core")->half_extent.x(), 0);
}

TEST_F(ViewerEditor, AHandleOfASphereChangesItsRadius)
{
    client::RegionInfo sphere = box(2);
    sphere.shape = "sphere";
    sphere.radius = 2;
    editor.on_regions({{"core", sphere}});
    const Lens lens = front();
    grip({.axis = 2, .side = -1}, *lens.project({0, 0, -2}));
    editor.drag(lens, *lens.project({0, 0, -3}));
    const auto command = send(start);
    ASSERT_TRUE(command);
    EXPECT_EQ(command->kind, "resize_roi");
    EXPECT_NEAR(command->radius, 3, 1e-9);
}

// A thousand pixels in a second, and an answer at once each time.
TEST_F(ViewerEditor, AtMostTwentyCommandsASecondGoOutAndTheLastIsTheNewest)
{
    grip(middle);
    std::vector<client::CommandRequest> commands;
    for (int ms = 0; ms < 1000; ++ms) {
        editor.drag(front(), {400 + 0.1 * ms, 300});
        if (auto command = send(start + ms * 1ms)) {
            commands.push_back(*command);
            answer(2 + commands.size());
        }
    }
    editor.release();
    if (auto command = send(start + 1050ms))
        commands.push_back(*command);
    EXPECT_GT(commands.size(), 10U);
    EXPECT_LE(commands.size(), 21U) << "twenty, and one on release";
    EXPECT_NEAR(front().project({commands.back().centre[0], 0, 0})->x, 499.9, 1e-9);
}

TEST_F(ViewerEditor, WhileACommandIsUnansweredTheNextOneWaits)
{
    grip(middle);
    editor.drag(front(), {450, 300});
    ASSERT_TRUE(send(start));
    editor.drag(front(), {460, 300});
    EXPECT_FALSE(send(start + 10s));
    answer(2);
    EXPECT_TRUE(send(start + 10s));
}

TEST_F(ViewerEditor, ARegionIsPendingUntilTheServerHasSaidThatItIsSo)
{
    grip(middle);
    editor.drag(front(), {450, 300});
    ASSERT_TRUE(send(start));
    editor.release();
    EXPECT_EQ(editor.phase("core"), Phase::Pending);
    answer(7);
    EXPECT_EQ(editor.phase("core"), Phase::Pending) << "answered, but its state has not come";
    editor.on_regions({{"core", box(6)}});
    EXPECT_EQ(editor.phase("core"), Phase::Pending) << "somebody else's change";
    editor.on_regions({{"core", box(7, {0.5, 0, 0})}});
    EXPECT_EQ(editor.phase("core"), Phase::Settled);
    EXPECT_EQ(editor.echo("core"), nullptr);
}

TEST_F(ViewerEditor, CancelSendsThePoseFromBeforeTheDrag)
{
    grip(middle);
    editor.drag(front(), {450, 300});
    ASSERT_TRUE(send(start));
    answer(2);
    editor.cancel();
    EXPECT_FALSE(editor.dragging());
    const auto command = send(start + 1s);
    ASSERT_TRUE(command);
    EXPECT_EQ(command->kind, "move_roi");
    EXPECT_EQ(command->centre, (std::array<double, 3>{0, 0, 0}));
}

TEST_F(ViewerEditor, ADragThatWasCancelledBeforeAnythingWasSentSendsNothing)
{
    grip(middle);
    editor.drag(front(), {450, 300});
    editor.cancel();
    EXPECT_FALSE(send(start));
    EXPECT_EQ(editor.phase("core"), Phase::Settled);
}

TEST_F(ViewerEditor, ARefusalShowsTheRegionAsTheServerHasIt)
{
    grip(middle);
    editor.drag(front(), {450, 300});
    ASSERT_TRUE(send(start));
    answer(0, slod_v1_RESULT_NOT_OWNER);
    EXPECT_FALSE(editor.dragging());
    EXPECT_EQ(editor.echo("core"), nullptr);
    EXPECT_FALSE(send(start + 1s));
}

TEST_F(ViewerEditor, ARegionThatIsRemovedWhileItIsDraggedIsLetGo)
{
    grip(middle);
    editor.drag(front(), {450, 300});
    editor.on_regions({});
    EXPECT_FALSE(editor.dragging());
    EXPECT_FALSE(send(start));
    EXPECT_FALSE(editor.on_answer(99, {}));
}

TEST_F(ViewerEditor, RegionsWithoutPlaceAndSizeHaveNoHandles)
{
    client::RegionInfo all = box(2);
    all.shape = "everywhere";
    editor.on_regions({{"core", all}});
    EXPECT_FALSE(editor.grip_at(front(), {400, 300}));
    EXPECT_TRUE(outline(all, nullptr, 1).empty());
}

TEST(ViewerCommands, APoseThatDiffersInPlaceAndSizeIsOneCommandWithBoth)
{
    const RegionPose small{.sphere = true, .centre = {0, 0, 0}, .radius = 1};
    RegionPose large = small;
    large.centre = {1, 2, 3};
    large.radius = 2.5;
    using Settings = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(command_between("core", small, large).value().settings,
              (Settings{{"centre", "[1, 2, 3]"}, {"radius", "2.5"}}));
    const RegionPose box{.centre = {0, 0, 0}, .half_extent = {1, 1, 1}};
    RegionPose moved = box;
    moved.centre = {0.5, 0, 0};
    moved.half_extent = {1.5, 1, 1};
    EXPECT_EQ(command_between("core", box, moved).value().settings,
              (Settings{{"centre", "[0.5, 0, 0]"}, {"half_extent", "[1.5, 1, 1]"}}));
}

TEST(ViewerOutline, EachShapeIsOutlinedWhereItIs)
{
    EXPECT_EQ(outline(box(1), nullptr, 1).size(), 12U) << "edges";
    client::RegionInfo frustum = box(1);
    frustum.shape = "frustum";
    frustum.direction = {0, 1, 0};
    frustum.up = {0, 0, 1};
    frustum.field_of_view_deg = 90;
    frustum.aspect = 2;
    frustum.near_distance = 1;
    frustum.far_distance = std::numeric_limits<double>::infinity();
    const auto segments = outline(frustum, nullptr, 4);
    ASSERT_EQ(segments.size(), 12U);
    EXPECT_TRUE(segments[0].from.isApprox(Vector(2, 1, 1)))
        << "half an opening of 45 degrees at a depth of 1";
    EXPECT_TRUE(segments[4].from.isApprox(Vector(10, 5, 5))) << "cut where it was asked to";
}

} // namespace
} // namespace slod::view
