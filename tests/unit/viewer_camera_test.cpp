#include <cmath>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "view/lens.hpp"
#include "view/scene_bounds.hpp"

namespace slod::view {
namespace {

constexpr Viewport picture{.width = 800, .height = 600};

/// A camera that looks at nothing special.
const Camera somewhere{
    .look_at = {3, -2, 7}, .distance = 20, .azimuth_deg = 37, .elevation_deg = -12, .field_of_view_deg = 50};

/// Pixels and lengths of a few hundred in doubles: some thousand roundings lose less than this.
constexpr double rounding = 1e-9;

void expect_same_place(const Pixel& left, const Pixel& right)
{
    EXPECT_NEAR(left.x, right.x, rounding);
    EXPECT_NEAR(left.y, right.y, rounding);
}

TEST(ViewerCamera, WhatItLooksAtIsInTheMiddle)
{
    expect_same_place(*Lens(somewhere, picture).project(somewhere.look_at), {400, 300});
}

TEST(ViewerCamera, RightAndUpInTheSceneAreRightAndUpInThePicture)
{
    const Camera front = seen_from(Camera{}, AxisView::Front);
    const Lens lens(front, picture);
    EXPECT_GT(lens.project({1, 0, 0})->x, 400);
    EXPECT_LT(lens.project({0, 0, 1})->y, 300);
    const Lens top(seen_from(Camera{}, AxisView::Top), picture);
    EXPECT_GT(top.project({1, 0, 0})->x, 400);
    EXPECT_LT(top.project({0, 1, 0})->y, 300);
}

TEST(ViewerCamera, WhatIsBehindItIsNotSeen)
{
    const Lens lens(somewhere, picture);
    EXPECT_FALSE(lens.project(somewhere.eye() - somewhere.forward()));
    EXPECT_FALSE(lens.project(somewhere.eye()));
}

TEST(ViewerCamera, ASightGoesThroughThePixelItIsOf)
{
    const Lens lens(somewhere, picture);
    const Pixel pixel{123, 456};
    const Ray ray = lens.ray(pixel);
    EXPECT_NEAR(ray.direction.norm(), 1, rounding);
    expect_same_place(*lens.project(ray.origin + 17 * ray.direction), pixel);
}

TEST(ViewerCamera, ZoomKeepsWhatIsUnderTheCursor)
{
    const Pixel cursor{650, 80};
    const Lens before(somewhere, picture);
    const Ray ray = before.ray(cursor);
    const Vector under =
        ray.origin + somewhere.distance / ray.direction.dot(somewhere.forward()) * ray.direction;
    const Camera nearer = zoomed(somewhere, picture, cursor.x, cursor.y, 0.4);
    EXPECT_DOUBLE_EQ(nearer.distance, 8);
    expect_same_place(*Lens(nearer, picture).project(under), cursor);
}

TEST(ViewerCamera, PanMovesWhatItLooksAtWithTheCursor)
{
    const Camera shifted = panned(somewhere, picture, 31, -17);
    expect_same_place(*Lens(shifted, picture).project(somewhere.look_at), {431, 283});
}

TEST(ViewerCamera, OrbitKeepsDistanceAndMiddleAndStopsAtThePoles)
{
    const Camera turned = orbited(somewhere, 100, 1e4);
    EXPECT_EQ(turned.look_at, somewhere.look_at);
    EXPECT_EQ(turned.distance, somewhere.distance);
    EXPECT_EQ(turned.elevation_deg, 90);
    EXPECT_NEAR(turned.azimuth_deg, somewhere.azimuth_deg - 30, rounding);
}

// A ball's edge is seen under asin(radius / distance).
TEST(ViewerCamera, AFittedBallFillsMostOfTheHeight)
{
    const Camera fit = fitted(somewhere, {1, 2, 3}, 5);
    EXPECT_EQ(fit.look_at, Vector(1, 2, 3));
    const double edge_px = Lens(fit, picture).focal_px() * std::tan(std::asin(5 / fit.distance));
    EXPECT_GT(edge_px, 0.75 * 300);
    EXPECT_LT(edge_px, 300);
    EXPECT_EQ(fitted(somewhere, {1, 2, 3}, 0), somewhere);
}

TEST(ViewerCamera, ItsTextGivesItBackToTheLastBit)
{
    Camera odd = somewhere;
    odd.look_at = {0.1, -1e300, 1.0 / 3};
    odd.distance = 1e-7 / 3;
    const auto read = camera_of(to_text(odd));
    ASSERT_TRUE(std::holds_alternative<Camera>(read));
    EXPECT_EQ(std::get<Camera>(read), odd);
}

TEST(ViewerCamera, WhatATextDoesNotMentionIsAsUsual)
{
    const auto read = camera_of("  distance=3\n");
    ASSERT_TRUE(std::holds_alternative<Camera>(read));
    Camera expected;
    expected.distance = 3;
    EXPECT_EQ(std::get<Camera>(read), expected);
}

TEST(ViewerCamera, AWrongTextIsRefusedWithTheKeyToBlame)
{
    for (const auto& [text, blamed] :
         {std::pair{"distance=0", "distance"}, std::pair{"distance=nan", "distance"},
          std::pair{"look_at=1,2", "look_at"}, std::pair{"look_at=1,2,x", "look_at"},
          std::pair{"elevation=91", "elevation"}, std::pair{"zoom=2", "zoom"}, std::pair{"left", "left"},
          std::pair{"field_of_view=180", "field_of_view"}, std::pair{"distance=1,", "distance"},
          std::pair{"", "no camera"}}) {
        SCOPED_TRACE(text);
        const auto read = camera_of(text);
        ASSERT_TRUE(std::holds_alternative<std::string>(read));
        EXPECT_NE(std::get<std::string>(read).find(blamed), std::string::npos) << std::get<std::string>(read);
    }
}

TEST(ViewerCamera, TheBulkOfASceneIgnoresWhatFliesAway)
{
    client::ClusterFrame frame;
    client::RegionClusters& region = frame.regions.emplace_back();
    region.origin = {1e6, 0, 0};
    for (int i = 0; i < 100; ++i) {
        const float x = i < 95 ? float(i % 5) - 2 : 1e9F;
        region.position.insert(region.position.end(), {x, 0, 0});
        region.mass.push_back(1);
        region.covariance.insert(region.covariance.end(), 6, 0);
    }
    const Ball bulk = bulk_of(frame);
    EXPECT_EQ(bulk.centre, Vector(1e6, 0, 0));
    EXPECT_EQ(bulk.radius, 2);
    EXPECT_EQ(bulk_of({}).radius, 0);
}

} // namespace
} // namespace slod::view
