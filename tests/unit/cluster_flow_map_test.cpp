#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "cluster/flow_map.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

constexpr double float_rounding = 0x1p-24;
constexpr double double_rounding = 0x1p-53;

/// A particle, or the centre of a cluster.
struct State {
    Vector3d position, velocity;
};

/// Attraction by a Plummer sphere at the origin: a smooth field that depends on the position.
Vector3d pull(const Vector3d& x)
{
    const double square = 1 + x.squaredNorm();
    return -x / (square * std::sqrt(square));
}

Symmetric3 tide(const Vector3d& x)
{
    const double square = 1 + x.squaredNorm();
    const double cube = square * std::sqrt(square);
    return Symmetric3::of(3 / (square * cube) * x * x.transpose() - Matrix3d::Identity() / cube);
}

/// Gravity, drag and wind over `time`, without recourse to UniformFields.
Propagator fall(double drag, double time)
{
    return {std::expm1(-drag * time), drag_drift(drag, time), {0.1, -0.2, -0.3}, {0.05, 0.02, -0.1}};
}

State step(State state, const Propagator& propagator, double time)
{
    state.velocity += 0.5 * time * pull(state.position);
    propagator.apply(state.position, state.velocity);
    state.velocity += 0.5 * time * pull(state.position);
    return state;
}

/// A unit offset in one of the six components.
MapBlocks::Offset unit(int component)
{
    MapBlocks::Offset offset{Vector3d::Zero(), Vector3d::Zero()};
    (component < 3 ? offset.position : offset.velocity)[component % 3] = 1;
    return offset;
}

double difference(const MapBlocks::Offset& a, const MapBlocks::Offset& b)
{
    return std::max((a.position - b.position).norm(), (a.velocity - b.velocity).norm());
}

/// The largest entry of the map.
double magnitude(const MapBlocks& map)
{
    return std::max({map.a.cwiseAbs().maxCoeff(), map.b.cwiseAbs().maxCoeff(), map.c.cwiseAbs().maxCoeff(),
                     map.d.cwiseAbs().maxCoeff()});
}

class FlowMapWithDrag : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Drags, FlowMapWithDrag, testing::Values(0.0, 0.3));

// Two particles at +-d about the centre, moved by the very same steps, are half their difference apart from
// the map's image of d by O(d^3): with d = 1e-4 and derivatives of order 1, 1e-8 of d. Each of the four
// operations on an entry in a step rounds it to float.
TEST_P(FlowMapWithDrag, IsTheTangentOfKicksAndSteps)
{
    constexpr double time = 0.05;
    constexpr double offset = 1e-4;
    constexpr int steps = 40;
    const Propagator propagator = fall(GetParam(), time);
    const State start{{0.8, -0.5, 0.3}, {0.2, 0.5, -0.4}};
    State centre = start;
    FlowMap map;
    for (int i = 0; i < steps; ++i) {
        kick(map, 0.5 * time, tide(centre.position));
        centre.velocity += 0.5 * time * pull(centre.position);
        propagate(map, propagator);
        propagator.apply(centre.position, centre.velocity);
        kick(map, 0.5 * time, tide(centre.position));
        centre.velocity += 0.5 * time * pull(centre.position);
    }
    const MapBlocks blocks = blocks_of(map, 1);
    for (int component = 0; component < 6; ++component) {
        std::array<State, 2> sides;
        for (int side = 0; side < 2; ++side) {
            const double d = side == 0 ? offset : -offset;
            sides[std::size_t(side)] = {start.position + d * unit(component).position,
                                        start.velocity + d * unit(component).velocity};
            for (int i = 0; i < steps; ++i)
                sides[std::size_t(side)] = step(sides[std::size_t(side)], propagator, time);
        }
        const MapBlocks::Offset measured{(sides[0].position - sides[1].position) / (2 * offset),
                                         (sides[0].velocity - sides[1].velocity) / (2 * offset)};
        EXPECT_LE(difference(measured, blocks.forward(unit(component))),
                  10 * offset * offset + 4 * steps * float_rounding * magnitude(blocks))
            << "component " << component;
    }
}

// A field with a curl has a gradient that is not symmetric: the transposes are no inverse then. Elimination
// loses a few roundings, times the magnitudes of map and inverse.
TEST(FlowMap, OfAFieldWithACurlIsInverted)
{
    const MapRule rule{MapKind::Full, 0.3, 0.05, false};
    Matrix3d gradient;
    gradient << -1, 2, 0.3, -2, 0.5, 1, 0.2, -1.4, 0.4;
    FlowMap map;
    for (int i = 0; i < 40; ++i) {
        kick(map, rule.step, gradient);
        propagate(map, fall(rule.drag, rule.step));
    }
    const MapBlocks blocks = rule.blocks(40, &map);
    const double size = magnitude(blocks);
    for (int component = 0; component < 6; ++component) {
        const MapBlocks::Offset back = blocks.inverse(blocks.forward(unit(component)));
        EXPECT_LE(difference(back, unit(component)),
                  100 * double_rounding * std::pow(size, 6) / blocks.volume());
    }
    // Kicks keep volumes, drag shrinks each of the three velocities.
    EXPECT_NEAR(blocks.volume() / std::exp(-3 * 0.3 * 40 * 0.05), 1, 40 * 6 * size * float_rounding);
}

TEST(FlowMap, AKickWithoutATideChangesNoBit)
{
    FlowMap map = test::aged_map({MapKind::Full, 0, 0.1}, 5, 1, 3);
    const FlowMap before = map;
    kick(map, 0.1, Symmetric3{});
    EXPECT_EQ(map.c, before.c);
    EXPECT_EQ(map.d_minus_1, before.d_minus_1);
}

// M^T J M = decay J, written out: A^T D - C^T B = decay, A^T C and B^T D symmetric. Each frame rounds each
// entry four times, and three products of three entries go into a sum.
TEST_P(FlowMapWithDrag, ShrinksPhaseSpaceByTheDecayAlone)
{
    constexpr std::uint64_t frames = 64;
    const MapRule rule{MapKind::Full, GetParam(), 0.05};
    const FlowMap full = test::aged_map(rule, frames, 2, 4);
    const MapBlocks map = rule.blocks(frames, &full);
    const double tolerance = 6 * 4 * frames * float_rounding * std::pow(magnitude(map), 2);
    EXPECT_NEAR(map.decay, std::exp(-GetParam() * 3.2), 1e-15);
    const Matrix3d mixed = map.a.transpose() * map.d - map.c.transpose() * map.b;
    EXPECT_LE((mixed - map.decay * Matrix3d::Identity()).cwiseAbs().maxCoeff(), tolerance);
    for (const Matrix3d& product : {Matrix3d(map.a.transpose() * map.c), Matrix3d(map.b.transpose() * map.d)})
        EXPECT_LE((product - product.transpose()).cwiseAbs().maxCoeff(), tolerance);
}

// The symplectic inverse is wrong by the map's rounding, e = 24 frames float_rounding |M|^2 / decay; one
// step of refinement leaves e^2.
TEST_P(FlowMapWithDrag, TheInverseUndoesTheMap)
{
    const MapRule rule{MapKind::Full, GetParam(), 0.05};
    for (const std::uint64_t frames : {0U, 1U, 8U, 64U}) {
        const FlowMap full = test::aged_map(rule, frames, 2, 5);
        const MapBlocks map = rule.blocks(frames, &full);
        const double first_error =
            24 * double(frames) * float_rounding * std::pow(magnitude(map), 2) / map.decay;
        for (int component = 0; component < 6; ++component) {
            const MapBlocks::Offset now = unit(component);
            EXPECT_LE(difference(map.forward(map.inverse(now)), now),
                      first_error * first_error +
                          100 * double_rounding * std::pow(magnitude(map), 2) / map.decay)
                << "component " << component << " after " << frames << " frames";
        }
    }
}

TEST_P(FlowMapWithDrag, TheScalarMapIsTheCompositionOfItsSteps)
{
    constexpr std::uint64_t frames = 1000;
    const MapRule rule{MapKind::Scalar, GetParam(), 0.01};
    const Propagator propagator = fall(GetParam(), rule.step);
    double b = 0, d = 1;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        b += propagator.drift * d;
        d += propagator.decay_minus_1 * d;
        const MapBlocks map = rule.blocks(frame, nullptr);
        // Two roundings in each step of the sums here.
        const double tolerance = 2 * double(frame) * double_rounding;
        ASSERT_NEAR(map.b(0, 0), b, tolerance * b + 1e-15) << "frame " << frame;
        ASSERT_NEAR(map.d(0, 0), d, tolerance * d + 1e-15) << "frame " << frame;
        ASSERT_EQ(map.decay, map.d(0, 0));
    }
    const MapBlocks map = rule.blocks(frames, nullptr);
    EXPECT_EQ(map.a, Matrix3d(Matrix3d::Identity()));
    EXPECT_EQ(map.c, Matrix3d(Matrix3d::Zero()));
    EXPECT_EQ(map.b, Matrix3d(map.b(0, 0) * Matrix3d::Identity()));
    EXPECT_EQ(map.d, Matrix3d(map.d(0, 0) * Matrix3d::Identity()));
}

TEST_P(FlowMapWithDrag, AFullMapWithoutTidesIsTheScalarOne)
{
    constexpr std::uint64_t frames = 64;
    const MapRule full_rule{MapKind::Full, GetParam(), 0.05};
    const MapRule scalar_rule{MapKind::Scalar, GetParam(), 0.05};
    const FlowMap map = test::aged_map(full_rule, frames, 0, 1);
    const MapBlocks full = full_rule.blocks(frames, &map);
    const MapBlocks scalar = scalar_rule.blocks(frames, nullptr);
    const double tolerance = 4 * frames * float_rounding * magnitude(scalar);
    EXPECT_LE((full.a - scalar.a).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LE((full.b - scalar.b).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LE((full.c - scalar.c).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LE((full.d - scalar.d).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_EQ(full.decay, scalar.decay);
}

TEST(FlowMap, TheIdentityIgnoresAgeAndDrag)
{
    const MapBlocks map = MapRule{MapKind::Identity, 3, 0.1}.blocks(1000, nullptr);
    const MapBlocks::Offset offset{{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(map.forward(offset).position, offset.position);
    EXPECT_EQ(map.forward(offset).velocity, offset.velocity);
    EXPECT_EQ(map.decay, 1);
}

// (1 - exp(-k t)) / k = t - k t^2 / 2 + k^2 t^3 / 6 - ..., whatever the size of k t.
TEST(DragDrift, GoesOverIntoFreeMotionAsDragVanishes)
{
    EXPECT_EQ(drag_drift(0, 3), 3);
    for (double drag = 1e-4; drag > 1e-300; drag *= 1e-3) {
        const double x = 3 * drag;
        EXPECT_NEAR(drag_drift(drag, 3) / (3 * (1 - x / 2 + x * x / 6)), 1, 1e-15 + x * x * x)
            << "drag " << drag;
    }
    EXPECT_EQ(drag_drift(1e6, 1e6), 1e-6);
}

} // namespace
} // namespace slod
