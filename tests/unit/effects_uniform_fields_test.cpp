#include <cmath>

#include <gtest/gtest.h>

#include "effects/uniform_fields.hpp"
#include "support/case_rows.hpp"

namespace slod {
namespace {

// The longest chain from the arguments to a result is some six operations, each rounded by half of this.
constexpr double epsilon = 0x1p-52;
constexpr double tolerance = 8 * epsilon;

/// (1 - exp(-x)) / x and (x - 1 + exp(-x)) / x^2, to 18 digits.
struct Exact {
    long double drift, fall;
};

Exact exact(long double x)
{
    if (x > 1)
        return {-std::expm1(-x) / x, (x + std::expm1(-x)) / (x * x)};
    // Series with terms of falling size, where the differences would cancel.
    long double drift = 0, fall = 0, term = 1;
    for (int n = 1; n < 40; ++n) {
        drift += term / n; // term is (-x)^(n-1) / (n-1)!
        fall += term / n / (n + 1);
        term *= -x / n;
    }
    return {drift, fall};
}

UniformFields fields(const Vector3d& gravity, double drag, const Vector3d& wind)
{
    UniformFields all;
    all.gravity = gravity;
    all.drag = drag;
    all.wind = wind;
    return all;
}

TEST(UniformFields, WithoutAnyMotionIsFree)
{
    const Propagator step = UniformFields().over(0.3);
    EXPECT_EQ(step.drift, 0.3);
    EXPECT_EQ(step.decay_minus_1, 0);
    EXPECT_EQ(step.shift, Vector3d(0, 0, 0));
    EXPECT_EQ(step.gain, Vector3d(0, 0, 0));
}

TEST(UniformFields, GravityAloneIsAParabola)
{
    Vector3d x{1, 2, 3}, v{4, 5, 6};
    fields({1, -2, -8}, 0, {0, 0, 0}).over(0.5).apply(x, v);
    EXPECT_EQ(x, Vector3d(3.125, 4.25, 5)); // all of these are binary fractions
    EXPECT_EQ(v, Vector3d(4.5, 4, 2));
}

TEST(UniformFields, F01_FollowTheirClosedFormsForAnyDrag)
{
    const Vector3d g{0.5, -1, -9.81}, u{3, -4, 1};
    for (double x = 1e-12; x < 2e6; x *= 1.3) {
        for (const double h : {1e-3, 1.0, 50.0}) {
            const double k = x / h;
            const Propagator step = fields(g, k, u).over(h);
            const auto kh = static_cast<long double>(k) * h;
            const Exact form = exact(kh);
            const double drift = double(form.drift * h);
            const double fall = double(form.fall * h * h);
            const double decay = double(std::expm1(-kh));
            test::expect_at_most("error of the decay, share", std::abs(step.decay_minus_1 / decay - 1),
                                 tolerance);
            test::expect_at_most("error of the drift, share", std::abs(step.drift / drift - 1), tolerance);
            // Where k h > 0.1 the fall is a difference that loses a factor of up to 2 / (k h) = 20.
            EXPECT_LE((step.shift - (k * fall * u + fall * g)).norm(),
                      20 * tolerance * fall * (k * u.norm() + g.norm()))
                << x;
            EXPECT_LE((step.gain - (-decay * u + drift * g)).norm(),
                      tolerance * (-decay * u.norm() + drift * g.norm()))
                << x;
        }
    }
}

// Two flows one after another are the flow over both times, whatever the drag; places go as far as 50 h.
TEST(UniformFields, TwoHalvesMakeTheWhole)
{
    const Vector3d g{0.5, -1, -9.81}, u{3, -4, 1};
    for (double x = 1e-12; x < 2e6; x *= 1.7) {
        const UniformFields all = fields(g, x, u);
        Vector3d whole_x{1, 2, 3}, whole_v{-4, 5, 6};
        Vector3d halves_x = whole_x, halves_v = whole_v;
        all.over(1).apply(whole_x, whole_v);
        all.over(0.25).apply(halves_x, halves_v);
        all.over(0.75).apply(halves_x, halves_v);
        EXPECT_LE((whole_x - halves_x).norm(), 20 * tolerance * 20) << x;
        EXPECT_LE((whole_v - halves_v).norm(), tolerance * 20) << x;
    }
}

TEST(UniformFields, DragAloneEndsAtTheStoppingDistance)
{
    Vector3d x{0, 0, 0}, v{3, 0, 0};
    fields({0, 0, 0}, 0.5, {0, 0, 0}).over(1e5).apply(x, v);
    EXPECT_EQ(v, Vector3d(0, 0, 0));
    EXPECT_EQ(x, Vector3d(6, 0, 0));
}

TEST(UniformFields, WindCarriesWhatHasItsVelocity)
{
    const Vector3d u{3, -4, 1};
    for (const double k : {1e-9, 0.05, 3.0, 1e6}) {
        Vector3d x{0, 0, 0}, v = u;
        fields({0, 0, 0}, k, u).over(0.7).apply(x, v);
        EXPECT_LE((v - u).norm(), tolerance * u.norm()) << k;
        EXPECT_LE((x - 0.7 * u).norm(), 20 * tolerance * u.norm()) << k;
    }
}

TEST(UniformFields, FallingEndsAtTheTerminalVelocity)
{
    const Vector3d g{0, 0, -9.81}, u{1, 2, 0};
    Vector3d x{0, 0, 0}, v{7, 7, 7};
    const UniformFields all = fields(g, 2, u);
    all.over(100).apply(x, v);
    EXPECT_LE((v - (u + g / 2)).norm(), tolerance * 5);
    // The velocity stays, however small the steps: a scheme that kicks would be off by (k h)^2 / 12.
    for (int i = 0; i < 1000; ++i)
        all.over(0.5).apply(x, v);
    EXPECT_LE((v - (u + g / 2)).norm(), tolerance * 5);
}

TEST(UniformFields, WindActsThroughTheDragAlone)
{
    const UniformFields still(std::nullopt, std::nullopt, UniformWindSettings{{5, 5, 5}});
    const Propagator step = still.over(1);
    EXPECT_EQ(step.shift, Vector3d(0, 0, 0));
    EXPECT_EQ(step.gain, Vector3d(0, 0, 0));
    const UniformFields windy(UniformGravitySettings{{0, 0, -1}}, LinearDragSettings{0.5},
                              UniformWindSettings{{5, 5, 5}});
    EXPECT_EQ(windy.drag, 0.5);
    EXPECT_EQ(windy.gravity, Vector3d(0, 0, -1));
    EXPECT_EQ(windy.wind, Vector3d(5, 5, 5));
}

TEST(UniformFields, OverNoTimeChangeNothing)
{
    const Propagator step = fields({1, 2, 3}, 4, {5, 6, 7}).over(0);
    EXPECT_EQ(step.drift, 0);
    EXPECT_EQ(step.decay_minus_1, 0);
    EXPECT_EQ(step.shift, Vector3d(0, 0, 0));
    EXPECT_EQ(step.gain, Vector3d(0, 0, 0));
}

} // namespace
} // namespace slod
