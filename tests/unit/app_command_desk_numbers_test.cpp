#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/settings_keys.hpp"
#include "unit/command_desk_fixture.hpp"

namespace slod {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// The desk that is asked for things that are no numbers.
class DeskOfNumbers : public Desk {
protected:
    /// Counts it, and whether it was refused and changed nothing.
    void try_out(const Request& asked, const std::string& what)
    {
        const std::uint64_t before = simulation.state_hash();
        const Answer answer = ask(asked);
        const bool refused = answer.result == slod_v1_RESULT_INVALID && !answer.field.empty() &&
                             answer.applied_frame == 0 && simulation.state_hash() == before &&
                             desk.editor().take_log().empty();
        EXPECT_TRUE(refused) << asked.kind << ' ' << what << ": " << answer.field << ": " << answer.text;
        ++tried_;
        taken_ += refused ? 0 : 1;
    }

    void report() const
    {
        test::report_value("values tried", tried_);
        test::expect_at_most("values taken that are no numbers", taken_, 0);
    }

private:
    int tried_ = 0, taken_ = 0;
};

TEST_F(DeskOfNumbers, N01_TakesNoPlaceSizeOrLeaseThatIsNone)
{
    for (const std::string shape : {"box", "sphere"}) {
        Request adding = add(shape);
        adding.radius = 1;
        adding.settings = {{"shape", shape}};
        ASSERT_EQ(ask(adding).result, slod_v1_RESULT_APPLIED);
    }
    desk.editor().take_log();
    for (const double bad : {no_number, infinite, -infinite}) {
        for (int axis = 0; axis < 3; ++axis) {
            Request adding = add("new"), resizing = request("resize_roi", "box");
            adding.half_extent[axis] = bad;
            try_out(adding, "half_extent");
            resizing.half_extent = {1, 1, 1};
            resizing.half_extent[axis] = bad;
            try_out(resizing, "half_extent");
            Vector3d centre(0, 0, 0);
            centre[axis] = bad;
            adding = add("new");
            adding.centre = centre;
            try_out(adding, "centre");
            try_out(move("box", centre), "centre");
        }
        Request adding = add("new"), resizing = request("resize_roi", "sphere");
        adding.settings = {{"shape", "sphere"}};
        adding.radius = bad;
        try_out(adding, "radius");
        resizing.radius = bad;
        try_out(resizing, "radius");
        try_out(add("new", alice, bad), "lease_s");
    }
    report();
}

TEST_F(DeskOfNumbers, N01_TakesNoSettingThatIsNone)
{
    ASSERT_EQ(ask(add("core")).result, slod_v1_RESULT_APPLIED);
    desk.editor().take_log();
    const auto try_each = [&](const std::string& kind, const std::string& region, const std::string& key,
                              const std::vector<std::string>& values) {
        for (const std::string& value : values) {
            Request asked = request(kind, region);
            asked.settings = {{key, value}};
            try_out(asked, key + " = " + value);
        }
    };
    RegionOfInterest core = *region("core");
    for_each_field(core, [&](const Field& field, const auto& value) {
        try_each("set_roi", "core", std::string(field.key), test::no_numbers(field, value));
    });
    SimulationSettings scene = simulation.settings();
    test::name_all(scene);
    for_each_effect(scene, [&]<class Table>(std::string_view name, Table& table) {
        if constexpr (requires { table.has_value(); })
            for_each_field(*table, [&](const Field& field, const auto& value) {
                try_each("set", {}, std::string(name) + "." + std::string(field.key),
                         test::no_numbers(field, value));
            });
    });
    for_each_field(scene.background, [&](const Field& field, const auto& value) {
        try_each("set", {}, "background." + std::string(field.key), test::no_numbers(field, value));
    });
    LoopSettings loop = desk.loop();
    test::for_each_key(loop, [&](const std::string& key, const Field& field, const auto& value) {
        try_each("set", {}, key, test::no_numbers(field, value));
    });
    report();
}

// A frustum follows; what cannot be one leaves it where it is.
TEST_F(DeskOfNumbers, N01_FollowsNoViewThatIsNone)
{
    Request adding = request("add_roi", "seen");
    adding.settings = {{"shape", "frustum"}, {"follows", "desk"}};
    ASSERT_EQ(ask(adding).result, slod_v1_RESULT_APPLIED);
    desk.editor().take_log();
    const ClientView sound{.client = bob, .client_name = "desk"};
    const std::uint64_t before = simulation.state_hash();
    int tried = 0, taken = 0;
    const auto show_bad = [&](const ClientView& view) {
        show(view);
        ++tried;
        const bool changed = simulation.state_hash() != before || !desk.editor().take_log().empty();
        EXPECT_FALSE(changed) << "view " << tried;
        taken += changed ? 1 : 0;
    };
    for (const double bad : {no_number, infinite, -infinite}) {
        for (Vector3d ClientView::*vector : {&ClientView::eye, &ClientView::look_at, &ClientView::up})
            for (int axis = 0; axis < 3; ++axis) {
                ClientView view = sound;
                (view.*vector)[axis] = bad;
                show_bad(view);
            }
        for (double ClientView::*angle : {&ClientView::field_of_view_deg, &ClientView::aspect}) {
            ClientView view = sound;
            view.*angle = bad;
            show_bad(view);
        }
    }
    test::report_value("views tried", tried);
    test::expect_at_most("views followed that are none", taken, 0);
    ClientView elsewhere = sound;
    elsewhere.eye = {1, 2, 3};
    show(elsewhere);
    EXPECT_FALSE(desk.editor().take_log().empty()) << "a sound view is followed";
}

} // namespace
} // namespace slod
