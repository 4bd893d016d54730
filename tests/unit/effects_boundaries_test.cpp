#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "effects/fields/field_set.hpp"
#include "support/field_at.hpp"

// Where effects of place begin and end, and which clusters that cuts.
namespace slod::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <PlaceField F>
double clearance_at(const typename F::Settings& settings, const Vector3d& x)
{
    return F(settings, FieldSource{}).clearance(x);
}

TEST(WindInABox, IsAsFarAsItsNearestFaceOrTheDepthWhereItIsWhole)
{
    const WindSettings wind{.centre = {10, 0, 0}, .half_extent = {4, 3, 2}, .edge = 1};
    struct Case {
        Vector3d x;
        double clearance;
    };
    for (const auto& [x, clearance] :
         {Case{{10, 0, 0}, 1},                                            // to z = 1
          Case{{10, 0, -1.25}, 0.25},                                     // from there
          Case{{10, 0, -1.75}, 0.25},                                     // to the face below
          Case{{13.5, 2.75, 0}, 0.25},                                    // to the nearer of two faces
          Case{{10, 0, 2}, 0}, Case{{10, 0, 7}, 5}, Case{{17, -7, 2}, 5}, // 3 and 4 from an edge of the box
          Case{{12, 7, 1}, 4}}) // over a plane where it is whole, outside
        EXPECT_DOUBLE_EQ(clearance_at<Wind>(wind, x), clearance) << x.transpose();
}

TEST(WindInABox, HasNoBoundaryAlongAnAxisWithoutBounds)
{
    const WindSettings slab{.half_extent = {infinity, infinity, 2}, .edge = 0.5};
    EXPECT_DOUBLE_EQ(clearance_at<Wind>(slab, {1e9, -1e9, 0.5}), 1);
    EXPECT_DOUBLE_EQ(clearance_at<Wind>(slab, {1e9, -1e9, 5}), 3);
    EXPECT_EQ(clearance_at<Wind>({.half_extent = Vector3d::Constant(infinity)}, {1, 2, 3}), infinity);
}

TEST(Attractor, IsAsFarAsTheSphereWhereItsPullEnds)
{
    const AttractorSettings bounded{.position = {1, 0, 0}, .radius = 2};
    EXPECT_DOUBLE_EQ(clearance_at<Attractor>(bounded, {1.5, 0, 0}), 1.5);
    EXPECT_DOUBLE_EQ(clearance_at<Attractor>(bounded, {4, 4, 0}), 3);
    EXPECT_EQ(clearance_at<Attractor>({}, {4, 4, 0}), infinity);
}

TEST(Buoyancy, IsAsFarAsTheNearerEndOfTheDepthOverWhichItSetsIn)
{
    const BuoyancySettings water{.level = 5, .up = {0, 0, 3}, .transition = 2};
    EXPECT_DOUBLE_EQ(clearance_at<Buoyancy>(water, {9, 9, 8}), 2);
    EXPECT_DOUBLE_EQ(clearance_at<Buoyancy>(water, {9, 9, 5.75}), 0.25);
    EXPECT_DOUBLE_EQ(clearance_at<Buoyancy>(water, {9, 9, 4.5}), 0.5);
    EXPECT_DOUBLE_EQ(clearance_at<Buoyancy>(water, {9, 9, 1}), 3);
}

// What is neither of these has the same formula everywhere.
TEST(EffectsOfPlace, HaveABoundaryWhereTheyEnd)
{
    EXPECT_TRUE(HasBoundary<Wind> && HasBoundary<Attractor> && HasBoundary<Buoyancy>);
    EXPECT_FALSE(HasBoundary<Spring> || HasBoundary<Vortex> || HasBoundary<Turbulence>);
    FieldSettings settings;
    const auto forces = [&] { return FieldSet<ForceFields>(settings, {}).has_boundary(); };
    settings.of<Attractor>() = {{}};
    settings.of<Spring>() = {{}};
    settings.of<Vortex>() = {{}};
    EXPECT_FALSE(forces());
    settings.of<Attractor>().push_back({.strength = 0, .radius = 1});
    EXPECT_FALSE(forces()) << "an element of no strength is none";
    settings.of<Attractor>().push_back({.radius = 1});
    EXPECT_TRUE(forces());
    settings.of<Wind>() = {{.half_extent = Vector3d::Constant(infinity)}};
    EXPECT_FALSE(FieldSet<AirFields>(settings, {}).has_boundary());
}

TEST(FieldSet, CountsAClusterForEachElementWhoseBoundaryIsWithinItsReach)
{
    FieldSettings settings;
    settings.of<Attractor>() = {{.radius = 1}, {.radius = 2}, {.radius = 4}, {}};
    settings.of<Buoyancy>() = {{.level = 10, .transition = 1}};
    FieldSet<ForceFields> fields(settings, {});
    EXPECT_DOUBLE_EQ(fields.clearance({0, 1.75, 0}), 0.25);
    fields.count_straddling({0, 1.75, 0}, 0.25); // touches, and does not reach across
    EXPECT_EQ(fields.take_counts(), FieldSet<ForceFields>::Counts{});
    fields.count_straddling({0, 1.75, 0}, 0.5);
    fields.count_straddling({0, 1.75, 0}, 1);
    fields.count_straddling({0, 1.75, 0}, 9);
    const auto counts = fields.take_counts();
    EXPECT_EQ(counts[0].straddling, 1U + 2U + 3U);
    EXPECT_EQ(counts[0].clusters, 0U) << "none was asked for";
    EXPECT_EQ(counts[3].straddling, 0U) << "the water begins 9.5 above";
    EXPECT_EQ(fields.take_counts(), FieldSet<ForceFields>::Counts{});
}

} // namespace
} // namespace slod::test
