#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "view/colour_scale.hpp"

namespace slod::view {
namespace {

client::ClusterFrame frame_of(double time, const std::vector<std::uint64_t>& formations)
{
    client::ClusterFrame frame;
    frame.time = time;
    client::RegionClusters& region = frame.regions.emplace_back();
    region.region = "background";
    region.formation = formations;
    for (std::size_t i = 0; i < formations.size(); ++i) {
        region.mass.push_back(float(i + 1));
        region.particles.push_back(std::uint32_t(i + 1));
        region.velocity.insert(region.velocity.end(), {0, 3, 4 * float(i)});
    }
    return frame;
}

TEST(ViewerColours, AShareIsLinearOrLogarithmicAndStaysWithinTheEnds)
{
    EXPECT_EQ(share_of(3, {.low = 1, .high = 5}, false), 0.5);
    EXPECT_NEAR(share_of(10, {.low = 1, .high = 100}, true), 0.5, 1e-15);
    EXPECT_EQ(share_of(-7, {.low = 1, .high = 5}, false), 0);
    EXPECT_EQ(share_of(7, {.low = 1, .high = 5}, false), 1);
    EXPECT_EQ(share_of(0, {.low = 1, .high = 5}, true), 0);
    EXPECT_EQ(share_of(std::numeric_limits<double>::quiet_NaN(), {.low = 1, .high = 5}, false), 0);
}

TEST(ViewerColours, AnOutlierDoesNotTakeTheRange)
{
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i)
        values.push_back(float(i));
    values.push_back(1e30F);
    const Range range = range_of(values, false);
    EXPECT_NEAR(range.low, 20, 1);
    EXPECT_NEAR(range.high, 980, 1);
}

TEST(ViewerColours, ARangeIsNeverEmpty)
{
    for (const bool logarithmic : {false, true})
        for (const std::vector<float>& values :
             {std::vector<float>{}, std::vector<float>{7, 7, 7}, std::vector<float>{0, 0},
              std::vector<float>{-3}, std::vector<float>{std::numeric_limits<float>::infinity()}}) {
            const Range range = range_of(values, logarithmic);
            EXPECT_LT(range.low, range.high);
            EXPECT_TRUE(!logarithmic || range.low > 0);
        }
}

TEST(ViewerColours, EachClusterHasTheColourOfItsValue)
{
    Colouring colouring;
    const client::ClusterFrame frame = frame_of(0, {1, 2, 3});
    const ColourScale fixed{.by = ColourBy::Count, .automatic = false, .low = 1, .high = 3};
    const auto colours = colouring.colours(frame, fixed);
    ASSERT_EQ(colours.size(), 3U);
    EXPECT_EQ(colours[0], colour_on_black(0));
    EXPECT_EQ(colours[2], colour_on_black(1));
    EXPECT_NE(colours[1], colours[0]);
    const auto by_speed = colouring.colours(frame, {.automatic = false, .low = 3, .high = 5});
    EXPECT_EQ(by_speed[0], colour_on_black(0));
    EXPECT_EQ(by_speed[1], colour_on_black(1)) << "3, 4 and 5 are the sides of a triangle";
}

TEST(ViewerColours, AnAutomaticRangeFollowsTheValues)
{
    Colouring colouring;
    (void)colouring.colours(frame_of(0, {1, 2, 3, 4, 5}), {.by = ColourBy::Mass});
    EXPECT_EQ(colouring.range().low, 1);
    EXPECT_GE(colouring.range().high, 4);
}

TEST(ViewerColours, ClustersOfOneRegionShareAColour)
{
    Colouring colouring;
    const auto colours = colouring.colours(frame_of(0, {1, 2}), {.by = ColourBy::Region});
    ASSERT_EQ(colours.size(), 2U);
    EXPECT_EQ(colours[0], colours[1]);
    EXPECT_EQ(colours[0], region_colour("background"));
    EXPECT_NE(region_colour("background"), region_colour("core"));
}

TEST(ViewerColours, AgeIsTheTimeSinceAClusterWasFormed)
{
    FormationAges ages;
    std::vector<float> values;
    ages.append(frame_of(10, {1, 2}), values);
    EXPECT_EQ(values, (std::vector<float>{0, 0}));
    values.clear();
    ages.append(frame_of(12, {1, 3}), values);
    EXPECT_EQ(values, (std::vector<float>{2, 0}));
    values.clear();
    ages.append(frame_of(15, {2, 3, 1}), values);
    EXPECT_EQ(values, (std::vector<float>{0, 3, 5})) << "what was gone begins anew";
}

} // namespace
} // namespace slod::view
