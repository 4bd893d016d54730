#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "unit/command_desk_fixture.hpp"

namespace slod {
namespace {

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

} // namespace
} // namespace slod
