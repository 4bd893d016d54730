#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "effects/air.hpp"
#include "support/case_rows.hpp"

// Air that resists by the square of the speed and blows in gusts and eddies.
namespace slod::test {
namespace {

constexpr double rounding = 0x1p-52;

struct State {
    Vector3d position{0, 0, 0}, velocity{0, 0, 0};
};

/// Steps of one particle through the air, `frames` of them in all of `time`.
State fly(const UniformFields& fields, double coefficient, const FieldSettings& winds, State state,
          double time, int frames)
{
    const double step = time / frames;
    const Air air(fields, QuadraticDragSettings{coefficient}, winds, {}, step);
    for (int frame = 0; frame < frames; ++frame)
        air.felt(state.position, state.velocity, frame * step, step)
            .fields.over(step)
            .apply(state.position, state.velocity);
    return state;
}

UniformFields falling(double linear, const Vector3d& gravity)
{
    UniformFields fields;
    fields.drag = linear;
    fields.gravity = gravity;
    return fields;
}

// dw/dt = -(k1 + k2 w) w has the solution w0 e^(-k1 h) / (1 + k2 w0 (1 - e^(-k1 h)) / k1), which a frame
// follows exactly, however stiff. Roundings are those of the logarithm,
// times its size below 30, and of the first velocity.
TEST(QuadraticDrag, F02_SlowsDownExactlyWithoutGravity)
{
    for (const double linear : {0.0, 1e-3, 2.0}) {
        for (const double stiffness : {1e-6, 0.3, 5.0, 1e6}) {
            const Vector3d v(3, -4, 12);
            const double drift = linear > 0 ? -std::expm1(-linear) / linear : 1.0;
            const double left = std::exp(-linear) / (1 + stiffness * drift);
            const State end = fly(falling(linear, {0, 0, 0}), stiffness / 13, {}, {{0, 0, 0}, v}, 1, 1);
            EXPECT_LE((end.velocity - left * v).norm(), 13 * rounding * (64 * 30 * left + 4))
                << linear << ' ' << stiffness;
            expect_at_most("error of the velocity, share", (end.velocity / (13 * left) - v / 13).norm(),
                           1e-9);
            expect_at_least("velocity left along the first", end.velocity.dot(v), 0);
        }
    }
}

// (k1 + k2 w) w = g at the terminal velocity, which stays to rounding, in wind too.
TEST(QuadraticDrag, F03_KeepsTheTerminalVelocityAtAnyStep)
{
    for (const double linear : {0.0, 0.4}) {
        for (const double step : {1e-3, 0.1, 10.0}) {
            const double k2 = 0.3, g = 9.81;
            const double speed = (std::sqrt(linear * linear + 4 * k2 * g) - linear) / (2 * k2);
            UniformFields fields = falling(linear, {0, 0, -g});
            fields.wind = {5, 1, 0};
            const Vector3d terminal = fields.wind - Vector3d(0, 0, speed);
            const State end = fly(fields, k2, {}, {{0, 0, 0}, terminal}, 50 * step, 50);
            expect_at_most("distance from the terminal velocity", (end.velocity - terminal).norm(), 1e-9);
        }
    }
}

TEST(QuadraticDrag, BringsEverythingToTheTerminalVelocity)
{
    const UniformFields fields = falling(0, {0, 0, -9.81});
    for (const Vector3d& start : {Vector3d(0, 0, 0), Vector3d(0, 0, 40), Vector3d(30, -20, 5)}) {
        const State end = fly(fields, 0.1, {}, {{0, 0, 0}, start}, 60, 600);
        EXPECT_LE((end.velocity - Vector3d(0, 0, -std::sqrt(98.1))).norm(), 1e-6); // transients e^(-g t / v)
    }
}

// Halving the step divides an error of second order by four, but for a share of terms of higher order.
TEST(QuadraticDrag, IsOfSecondOrderInTransients)
{
    const UniformFields fields = falling(0.2, {0, 0, -9.81});
    for (const Vector3d& start : {Vector3d(0, 0, 0), Vector3d(8, 0, 12), Vector3d(0, -3, -30)}) {
        const State exact = fly(fields, 0.15, {}, {{0, 0, 0}, start}, 1, 1 << 14);
        const auto error = [&](int frames) {
            const State end = fly(fields, 0.15, {}, {{0, 0, 0}, start}, 1, frames);
            return (end.position - exact.position).norm() + (end.velocity - exact.velocity).norm();
        };
        const double order = std::log2(error(64) / error(128));
        EXPECT_GT(order, 1.8) << start.transpose();
        EXPECT_LT(error(128), 1e-3);
    }
}

// Central differences of step d: truncation by the third derivative, of order 1 here, and rounding over d.
TEST(QuadraticDrag, HasTheSlopeOfItsMean)
{
    constexpr double d = 0x1p-14;
    for (const double linear : {0.0, 0.5}) {
        for (const Vector3d& g : {Vector3d(0, 0, 0), Vector3d(0, 0, -9.81), Vector3d(1e-9, 0, 0)}) {
            for (int i = 0; i < 100; ++i) {
                Random random(3, 0, std::uint64_t(i));
                Vector3d w;
                for (int axis = 0; axis < 3; ++axis)
                    w[axis] = 20 * random.uniform() - 10;
                const double time = 0.05;
                if (w.norm() < 2 * g.norm() * time)
                    continue; // where directions turn within the frame the slope is bounded instead
                const MeanDrag here = mean_drag(linear, 0.3, w, g, time);
                for (int axis = 0; axis < 3; ++axis) {
                    const Vector3d e = d * Vector3d::Unit(axis);
                    const double slope = (mean_drag(linear, 0.3, w + e, g, time).rate -
                                          mean_drag(linear, 0.3, w - e, g, time).rate) /
                                         (2 * d);
                    EXPECT_NEAR(here.slope[axis], slope, 10 * d * d + 64 * rounding / time / d)
                        << w.transpose() << ", g " << g.transpose();
                }
            }
        }
    }
}

// A wind that is there at once carries along without overshoot, 63 % of it after 1 / k.
TEST(Wind, F06_StartingAtOnceIsFollowedMonotonically)
{
    FieldSettings winds;
    winds.of<Wind>() = {{.velocity = {100, 0, 0}, .half_extent = Vector3d::Constant(INFINITY)}};
    const double step = 1.0 / 60, k = 50;
    double before = 0;
    State state;
    for (int frame = 1; frame <= 60; ++frame) {
        state = fly(falling(k, {0, 0, 0}), 0, winds, state, step, 1);
        expect_at_least("gain of velocity in a frame", state.velocity.x() - before, 0);
        expect_at_most("velocity in a wind of 100", state.velocity.x(), 100);
        EXPECT_NEAR(state.velocity.x(), -100 * std::expm1(-k * frame * step), 1e-11);
        before = state.velocity.x();
    }
}

TEST(Wind, ComesInGusts)
{
    const WindSettings settings{.velocity = {2, 0, 0},
                                .half_extent = Vector3d::Constant(INFINITY),
                                .gust_amplitude = 0.5,
                                .gust_period = 8};
    const auto at = [&](double time) {
        FieldValue sum;
        Wind(settings, {}).add({0, 0, 0}, time, sum);
        return sum.value.x();
    };
    EXPECT_EQ(at(0), 2);
    EXPECT_NEAR(at(2), 3, 4 * rounding);
    EXPECT_NEAR(at(8e6 + 6), 1, 4 * rounding); // after a million gusts just as well
}

TEST(Wind, IsNoneOutsideItsBoxAndWholeWithinItsEdges)
{
    const WindSettings settings{
        .velocity = {0, 3, 0}, .centre = {1, 1, 1}, .half_extent = {2, 1, 1}, .edge = 0.5};
    const auto at = [&](const Vector3d& x) {
        FieldValue sum;
        Wind(settings, {}).add(x, 0, sum);
        return sum;
    };
    EXPECT_EQ(at({2.4, 1.4, 0.6}).value, Vector3d(0, 3, 0));
    EXPECT_EQ(at({2.4, 1.4, 0.6}).gradient, Matrix3d(Matrix3d::Zero()));
    for (const Vector3d& x : {Vector3d(3, 1, 1), Vector3d(1, 2, 1), Vector3d(1, 1, -0.5), Vector3d(9, 9, 9)})
        EXPECT_EQ(at(x).value, Vector3d(0, 0, 0));
    EXPECT_NEAR(at({2.75, 1, 1}).value.y(), 1.5, 8 * rounding); // halfway through the edge
}

TEST(Wind, RefusesAnEdgeThatLeavesNoPlaceOfFullWind)
{
    WindSettings settings{.half_extent = {4, INFINITY, 2}, .edge = 2};
    const auto full = [&] {
        FieldValue sum;
        Wind(settings, {}).add(settings.centre, 0, sum);
        return sum.value == settings.velocity;
    };
    EXPECT_EQ(Wind::problems(settings, 1), Problems{});
    EXPECT_TRUE(full());
    settings.edge = 2.5;
    EXPECT_FALSE(full());
    const Problems found = Wind::problems(settings, 1);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NE(found[0].find("edge = 2.5 is more than the shortest of half_extent, 2"), std::string::npos);
    settings.half_extent.setConstant(INFINITY);
    EXPECT_EQ(Wind::problems(settings, 1), Problems{}) << "wind without a box has no edge";
}

class Eddies : public testing::Test {
protected:
    static Vector3d some_place(int index)
    {
        Random random(11, 0, std::uint64_t(index));
        Vector3d x;
        for (int axis = 0; axis < 3; ++axis)
            x[axis] = 200 * random.uniform();
        return x;
    }

    static FieldValue at(const Turbulence& turbulence, const Vector3d& x, double time)
    {
        FieldValue sum;
        turbulence.add(x, time, sum);
        return sum;
    }

    const TurbulenceSettings settings_{.amplitude = 2, .length = 5, .octaves = 4};
    const Turbulence turbulence_{settings_, FieldSource{1}};
};

// The closed form leaves roundings of 48 waves alone. By central differences of d = 1e-6 L the shortest
// waves, of L / 8, are off by (2 pi 8 d / L)^2 / 6 = 4e-10 of gradients of up to 50 |u| / L, and phases of up
// to 550 turns, rounded by 6e-14 of one, by 2 pi 6e-14 |u| / 2 d = 2e-7 |u| / L.
TEST_F(Eddies, F07_HaveNoDivergence)
{
    const double d = 1e-6 * settings_.length, unit = settings_.amplitude / settings_.length;
    for (int i = 0; i < 1000; ++i) {
        const Vector3d x = some_place(i);
        const double time = 0.1 * i;
        const FieldValue here = at(turbulence_, x, time);
        EXPECT_LE(std::abs(here.gradient.trace()), 48 * 8 * rounding * 2 * here.gradient.norm() + 1e-13);
        double divergence = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const Vector3d e = d * Vector3d::Unit(axis);
            divergence +=
                (at(turbulence_, x + e, time).value - at(turbulence_, x - e, time).value)[axis] / (2 * d);
        }
        expect_at_most("divergence by differences, |u| / L", std::abs(divergence) / unit, 1e-6);
        expect_at_most("divergence in closed form, |u| / L", std::abs(here.gradient.trace()) / unit, 1e-6);
    }
}

// Its mean square is that of 48 waves of squared cosines, whose mean over 20,000 places is within 5 % of it:
// places some eddies apart are independent, and the square scatters by sqrt(2/3) / sqrt(20000), 0.6 %.
TEST_F(Eddies, HaveTheSpeedThatIsAskedFor)
{
    double sum = 0;
    Vector3d mean(0, 0, 0);
    constexpr int places = 20'000;
    for (int i = 0; i < places; ++i) {
        const Vector3d u = at(turbulence_, some_place(i), 0).value;
        sum += u.squaredNorm() / places;
        mean += u / places;
    }
    EXPECT_NEAR(std::sqrt(sum), 2, 0.05 * 2);
    EXPECT_LE(mean.norm(), 5 * 2 / std::sqrt(double(places)));
}

TEST_F(Eddies, FollowTheSeed)
{
    const Turbulence same(settings_, FieldSource{1}), other(settings_, FieldSource{2});
    const Vector3d x(1, 2, 3);
    EXPECT_EQ(at(same, x, 1).value, at(turbulence_, x, 1).value);
    EXPECT_GT((at(other, x, 1).value - at(turbulence_, x, 1).value).norm(), 0.01);
}

TEST_F(Eddies, OfInfiniteTimeAreFrozen)
{
    TurbulenceSettings frozen = settings_;
    frozen.time = INFINITY;
    const Turbulence still(frozen, FieldSource{1});
    EXPECT_EQ(at(still, {1, 2, 3}, 0).value, at(still, {1, 2, 3}, 1e3).value);
    EXPECT_GT((at(turbulence_, {1, 2, 3}, 0).value - at(turbulence_, {1, 2, 3}, 1e3).value).norm(), 0.01);
}

// Linearised about its cluster: what is left out is of second order in the offset, so halving that quarters
// it, but for a share of third order.
TEST_F(Eddies, AreFeltByMembersAsLinearAboutTheirCluster)
{
    FieldSettings winds;
    winds.of<Turbulence>() = settings_;
    const Air air(falling(2, {0, 0, -9.81}), QuadraticDragSettings{0.2}, winds, {1}, 0.02);
    const Vector3d x(1, 2, 3), v(3, -1, 2);
    const Air::Felt cluster = air.felt(x, v, 0, 0.02);
    const auto error = [&](double offset) {
        const Vector3d place = x + offset * Vector3d(0.6, 0.64, -0.48),
                       speed = v + offset * Vector3d(1, 2, -1);
        const UniformFields own = air.felt(place, speed, 0, 0.02).fields;
        const UniformFields member = air.felt_by_member(cluster, place, speed);
        return (own.wind - member.wind).norm() + std::abs(own.drag - member.drag);
    };
    EXPECT_GT(std::log2(error(0.04) / error(0.02)), 1.8);
    EXPECT_EQ(error(0), 0);
}

// Without a drag worth mentioning tracers would fall behind; with a strong one they go with the air: the
// error of a step is of second order there too.
TEST_F(Eddies, CarryTracersToSecondOrder)
{
    FieldSettings winds;
    winds.of<Turbulence>() = settings_;
    const auto end = [&](int frames) {
        const double step = 1.0 / frames;
        const Air air(falling(2000, {0, 0, 0}), {}, winds, {1}, step);
        State state{{1, 2, 3}, at(turbulence_, {1, 2, 3}, 0).value};
        for (int frame = 0; frame < frames; ++frame)
            air.felt(state.position, state.velocity, frame * step, step)
                .fields.over(step)
                .apply(state.position, state.velocity);
        return state.position;
    };
    const Vector3d exact = end(1 << 14);
    const double coarse = (end(32) - exact).norm(), fine = (end(64) - exact).norm();
    EXPECT_GT(std::log2(coarse / fine), 1.6);
    EXPECT_LT(fine, 0.01);
}

} // namespace
} // namespace slod::test
