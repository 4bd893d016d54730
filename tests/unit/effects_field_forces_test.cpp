#include <cmath>

#include <gtest/gtest.h>

#include "effects/fields/attractor.hpp"
#include "effects/fields/field_set.hpp"
#include "effects/fields/spring.hpp"
#include "support/case_rows.hpp"
#include "support/field_at.hpp"

// Accelerations of place against their closed forms.
namespace slod::test {
namespace {

TEST(Attractor, PullsByTheInverseSquareOfASoftenedDistance)
{
    const Vector3d d(3, 0, 0);
    const FieldValue far =
        field_at<Attractor>({.position = {1, 2, 3}, .strength = 5, .softening = 4}, d + Vector3d(1, 2, 3));
    EXPECT_LE((far.value - Vector3d(-5 * 3 / 125.0, 0, 0)).norm(), field_tolerance);
}

TEST(Attractor, F09_DoesNotPullWhatIsAtItsPlace)
{
    const FieldValue here = field_at<Attractor>({.position = {1, 2, 3}, .softening = 0.1}, {1, 2, 3});
    expect_at_most("acceleration", here.value.norm(), 0);
    EXPECT_NEAR(here.gradient.trace(), -3 / 1e-3, 3e3 * field_tolerance);
}

TEST(Attractor, OfNegativeStrengthRepels)
{
    const FieldValue pulled = field_at<Attractor>({.strength = 2}, {0.3, 1, -2});
    const FieldValue pushed = field_at<Attractor>({.strength = -2}, {0.3, 1, -2});
    EXPECT_EQ(pushed.value, Vector3d(-pulled.value));
    EXPECT_EQ(pushed.gradient, Matrix3d(-pulled.gradient));
}

TEST(Attractor, FadesTowardsItsRadiusAndIsNothingBeyond)
{
    const AttractorSettings bounded{.strength = 1, .softening = 0.1, .radius = 2};
    const AttractorSettings unbounded{.strength = 1, .softening = 0.1};
    double share = 1;
    for (double r = 0.01; r < 2; r += 0.01) {
        const Vector3d x(r, 0, 0);
        const double depth = Attractor(bounded, {}).potential(x) / Attractor(unbounded, {}).potential(x);
        EXPECT_LT(depth, share);
        share = depth;
    }
    EXPECT_EQ(field_at<Attractor>(bounded, {2, 0, 0}).value, Vector3d(0, 0, 0));
    EXPECT_EQ(field_at<Attractor>(bounded, {1.5, 1.5, 0}).value, Vector3d(0, 0, 0));
}

TEST(Spring, F27_OfNoLengthPullsNothing)
{
    expect_at_most("acceleration",
                   field_at<Spring>({.anchor = {1, 2, 3}, .stiffness = 1e6}, {1, 2, 3}).value.norm(), 0);
}

// Kicks at the ends of a frame are stable up to an angular frequency of 2 / step.
TEST(Spring, F26_TooStiffForTheStepIsRefused)
{
    const double step = 0.25;
    EXPECT_TRUE(Spring::problems({.stiffness = 63.9}, step).empty());
    int refused = 0;
    for (const double turn : {2.0, 100.0}) // in a frame
        refused += Spring::problems({.stiffness = turn * turn / (step * step)}, step).empty() ? 0 : 1;
    expect_at_least("springs of w dt = 2 and 100 refused", refused, 2);
}

TEST(FieldSet, SumsItsElementsWhateverTheirOrder)
{
    FieldSettings one, other;
    auto& table = one.of<Attractor>();
    for (int i = 0; i < 5; ++i)
        table.push_back({.position = {0.1 * i, 0.37 * i * i, 1}, .strength = 1.0 / (i + 1)});
    other.of<Attractor>().assign(table.rbegin(), table.rend());
    const FieldSet<ForceFields> a(one, {}), b(other, {});
    for (int i = 0; i < 20; ++i) {
        const Vector3d x(0.3 * i, -0.2, 0.7 / (i + 1));
        EXPECT_EQ(a.at(x, 0).value, b.at(x, 0).value); // E-11: to the bit
        EXPECT_EQ(a.at(x, 0).gradient, b.at(x, 0).gradient);
    }
}

// E-8
TEST(FieldSet, AsksNoEffectOutsideItsBounds)
{
    FieldSettings settings;
    settings.of<Attractor>() = {{.radius = 0.1}, {.position = {5, 0, 0}, .radius = 0.2}};
    FieldSet<ForceFields> fields(settings, {});
    std::vector<Vector3d> places;
    for (int i = 0; i < 100; ++i)
        places.push_back({0.1 * i, 0, 0});
    std::vector<FieldValue> sums(places.size());
    fields.add(
        0, places.size(), [](std::size_t) { return true; },
        [&](std::size_t i) -> const Vector3d& { return places[i]; }, 0, sums.data());
    const auto counts = fields.take_counts();
    EXPECT_EQ(counts[0].calls, 2U);
    EXPECT_LE(counts[0].clusters, 6U)
        << "one within 0.1 of the origin, four of 5, and one that rounding may add";
    EXPECT_GE(counts[0].clusters, 4U);
    for (std::size_t row = 1; row < counts.size(); ++row)
        EXPECT_EQ(counts[row], FieldCount{}) << "an absent effect is never asked";
    EXPECT_EQ(fields.take_counts(), FieldSet<ForceFields>::Counts{});
}

} // namespace
} // namespace slod::test
