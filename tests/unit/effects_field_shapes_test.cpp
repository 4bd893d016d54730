#include <cmath>

#include <gtest/gtest.h>

#include "effects/fields/buoyancy.hpp"
#include "effects/fields/vortex.hpp"
#include "support/case_rows.hpp"
#include "support/field_at.hpp"

// Vortices and water by their formulae.
namespace slod::test {
namespace {

TEST(Vortex, F08_IsFiniteOnItsLine)
{
    const FieldValue here = field_at<Vortex>({.position = {1, 2, 3}, .core_radius = 0.1}, {1, 2, 7});
    expect_at_most("acceleration on the line", here.value.norm(), 0);
    EXPECT_TRUE(here.gradient.allFinite());
}

TEST(Vortex, TurnsByTheRightHandAndFallsOffWithTheDistance)
{
    const VortexSettings vortex{.axis = {0, 0, 2}, .strength = 6, .core_radius = 1};
    EXPECT_LE((field_at<Vortex>(vortex, {3, 0, 5}).value - Vector3d(0, 6 * 3 / 10.0, 0)).norm(),
              8 * field_tolerance);
    EXPECT_LE((field_at<Vortex>(vortex, {0, 1, 0}).value - Vector3d(-3, 0, 0)).norm(), 8 * field_tolerance);
}

// The lift is continuous at the surface, and so is its slope.
TEST(Buoyancy, F29_SetsInContinuouslyAboutTheLevel)
{
    const BuoyancySettings water{.level = 2, .lift = 3, .transition = 0.5};
    EXPECT_EQ(field_at<Buoyancy>(water, {0, 0, 2.25}).value.z(), 0);
    EXPECT_NEAR(field_at<Buoyancy>(water, {0, 0, 2}).value.z(), 1.5, field_tolerance);
    EXPECT_EQ(field_at<Buoyancy>(water, {0, 0, 1.75}).value.z(), 3);
    double before = 0, slope_before = 0;
    for (double z = 2.3; z > 1.7; z -= 1e-4) {
        const FieldValue here = field_at<Buoyancy>(water, {0, 0, z});
        // The slope is at most 1.5 lift / transition, and its own 6 lift / transition^2.
        expect_at_most("jump of the lift in a step of 1e-4", std::abs(here.value.z() - before),
                       1e-4 * 1.5 * 3 / 0.5 * (1 + 1e-9));
        expect_at_most("jump of its slope in a step of 1e-4", std::abs(here.gradient(2, 2) - slope_before),
                       1e-4 * 6 * 3 / 0.25 * (1 + 1e-9));
        before = here.value.z();
        slope_before = here.gradient(2, 2);
    }
}

} // namespace
} // namespace slod::test
