#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "view/splats.hpp"

namespace slod::view {
namespace {

constexpr Viewport picture{.width = 400, .height = 300};

/// Looks along +y at the origin, x to the right, z up, from a distance of 100.
Camera front()
{
    Camera camera = seen_from(Camera{}, AxisView::Front);
    camera.distance = 100;
    return camera;
}

struct Cluster {
    std::array<float, 3> place{};
    std::array<float, 6> covariance{}; ///< xx xy xz yy yz zz
};

/// Splats of clusters of ten particles each.
Splats splats_of(const std::vector<Cluster>& clusters, const Camera& camera, const LevelOfDetail& detail = {})
{
    client::ClusterFrame frame;
    client::RegionClusters& region = frame.regions.emplace_back();
    for (const Cluster& cluster : clusters) {
        region.position.insert(region.position.end(), cluster.place.begin(), cluster.place.end());
        region.covariance.insert(region.covariance.end(), cluster.covariance.begin(),
                                 cluster.covariance.end());
        region.mass.push_back(1);
        region.particles.push_back(10);
    }
    const std::vector<std::uint32_t> colours(clusters.size(), 0xffffffff);
    Splats splats;
    project(frame, Lens(camera, picture), colours, detail, splats);
    return splats;
}

/// Relative error of a chain of some twenty float operations, each within 6e-8.
constexpr double float_rounding = 2e-6;

// Half axes of sqrt(8) standard deviations, each of focal / distance pixels, with a quarter square pixel
// added.
TEST(ViewerSplats, ARoundClusterIsADiscOfItsTrueSize)
{
    const float variance = 9;
    const Splats splats = splats_of({{{}, {variance, 0, 0, variance, 0, variance}}}, front());
    ASSERT_EQ(splats.ellipses.size(), 1U);
    const EllipseSplat& disc = splats.ellipses[0];
    const double to_px = Lens(front(), picture).focal_px() / 100;
    const double expected = std::sqrt(8 * (variance * to_px * to_px + 0.25));
    EXPECT_NEAR(disc.half_width / expected, 1, float_rounding);
    EXPECT_NEAR(disc.half_height / expected, 1, float_rounding);
    EXPECT_NEAR(disc.x, 200, 1e-3);
    EXPECT_NEAR(disc.y, 150, 1e-3);
    EXPECT_NEAR(disc.a * expected * expected, 1, float_rounding);
    EXPECT_NEAR(disc.b * expected * expected, 0, float_rounding);
}

TEST(ViewerSplats, ALongClusterPointsWhereItPointsInTheScene)
{
    // Along x = z: to the right and up.
    const Splats splats = splats_of({{{}, {9, 0, 9, 0.01F, 0, 9}}}, front());
    ASSERT_EQ(splats.ellipses.size(), 1U);
    const EllipseSplat& splat = splats.ellipses[0];
    const auto u = [&](double dx, double dy) {
        return splat.a * dx * dx + 2 * splat.b * dx * dy + splat.c * dy * dy;
    };
    const double reach = 0.5 * splat.half_width;
    EXPECT_LT(u(reach, -reach), 1) << "the picture's y runs downwards";
    EXPECT_GT(u(reach, reach), 1);
}

// Sampled on each pixel: the kernel is smooth over many pixels, and its sum is its integral but for the edge.
TEST(ViewerSplats, TheLightOfAnEllipseIsItsParticles)
{
    const Splats splats = splats_of({{{}, {30, 8, -5, 20, 3, 10}}}, front());
    ASSERT_EQ(splats.ellipses.size(), 1U);
    const EllipseSplat& splat = splats.ellipses[0];
    double light = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const double dx = x + 0.5 - splat.x, dy = y + 0.5 - splat.y;
            const double rest = 1 - (splat.a * dx * dx + 2 * splat.b * dx * dy + splat.c * dy * dy);
            light += rest > 0 ? splat.light * rest * rest : 0;
        }
    EXPECT_NEAR(light, 10, 0.01);
}

TEST(ViewerSplats, AClusterIsAPointWhenFarAndAnEllipseWhenNear)
{
    const std::vector<Cluster> one{{{}, {1, 0, 0, 1, 0, 1}}};
    Camera camera = front();
    EXPECT_EQ(splats_of(one, camera).ellipses.size(), 1U);
    camera.distance = 1e4;
    EXPECT_EQ(splats_of(one, camera).points.size(), 1U);
    EXPECT_EQ(splats_of(one, camera).ellipses.size(), 0U);
}

TEST(ViewerSplats, WithoutShapesAllArePoints)
{
    EXPECT_EQ(splats_of({{{}, {9, 0, 0, 9, 0, 9}}}, front(), {.shapes = false}).points.size(), 1U);
}

TEST(ViewerSplats, WhatIsBehindTheEyeOrBesideThePictureIsLeftOut)
{
    const Splats splats =
        splats_of({{{0, -200, 0}, {}}, {{1000, 0, 0}, {}}, {{1000, 0, 0}, {1, 0, 0, 1, 0, 1}}}, front());
    EXPECT_TRUE(splats.points.empty());
    EXPECT_TRUE(splats.ellipses.empty());
    EXPECT_EQ(splats.typical_light, 0);
}

TEST(ViewerSplats, ANumberThatIsNoneHarmsNobodyElse)
{
    const float none = std::numeric_limits<float>::quiet_NaN();
    const Splats splats = splats_of({{{none, 0, 0}, {}}, {{}, {none, 0, 0, none, 0, 1}}, {}}, front());
    EXPECT_EQ(splats.points.size(), 2U) << "without a shape that can be drawn it is a point";
    EXPECT_TRUE(std::isfinite(splats.typical_light));
}

TEST(ViewerSplats, ManyLargeEllipsesAreDrawnCoarselyAndThinOnesNot)
{
    std::vector<Cluster> clusters(100, {{}, {400, 0, 0, 400, 0, 400}});
    clusters.push_back({{}, {400, 0, 0, 0, 0, 0}});
    Splats splats = splats_of(clusters, front());
    ASSERT_EQ(splats.ellipses.size(), 101U);
    coarsen(splats, picture, 1e9);
    EXPECT_EQ(splats.coarse_count, 0U);
    coarsen(splats, picture, 1e5);
    EXPECT_EQ(splats.coarse_count, 100U);
    EXPECT_GT(splats.coarse_px, 1);
    EXPECT_LT(splats.ellipses.back().half_height, 2);
}

TEST(ViewerSplats, TheSumOfPointsHoldsAllTheirLightWhereTheyAre)
{
    const std::vector<PointSplat> points{
        {100, 50, 2, 0xff0000ff}, {100, 50, 3, 0xff0000ff}, {0, 0, 1, 0xff00ff00}};
    PointSum sum;
    const auto light = sum.sum(points, picture, 10);
    const auto at = [&](int x, int y, int channel) {
        return light[std::size_t(4 * ((picture.height - 1 - y) * picture.width + x) + channel)];
    };
    EXPECT_EQ(at(99, 49, 0), 50) << "red";
    EXPECT_EQ(at(100, 50, 3), 50) << "light";
    EXPECT_EQ(at(100, 50, 1), 0) << "green";
    EXPECT_EQ(at(101, 50, 3), 0);
    EXPECT_EQ(at(0, 0, 1), 10) << "a quarter of a square at the corner";
}

} // namespace
} // namespace slod::view
