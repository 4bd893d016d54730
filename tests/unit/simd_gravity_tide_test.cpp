#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "unit/simd_gravity_support.hpp"

namespace slod::simd {
namespace {

TYPED_TEST_SUITE(GravityKernel, Precisions, PrecisionNames);

constexpr double step = 0x1p-13;

/// How far a central difference over 2 steps may be from the tide. Any third derivative of a softened pair's
/// acceleration is at most 4! m / r^5, which makes the truncation at most 4 step^2 sum m / r^5; r is at least
/// 1/2 here, and 1 % covers its change over a step. Both accelerations' rounding is divided by 2 steps.
long double slope_tolerance(const Bodies<double>& targets, std::size_t t, const Bodies<double>& sources,
                            std::size_t acceleration, std::size_t tide)
{
    long double curvature = 0;
    for (std::size_t s = 0; s < sources.count(); ++s) {
        const double distance =
            std::hypot(sources.x[s] - targets.x[t], sources.y[s] - targets.y[t], sources.z[s] - targets.z[t]);
        const double square = distance * distance + sources.q[s] + targets.q[t];
        curvature += sources.mass[s] / (square * square * std::sqrt(square));
    }
    const Reference exact = reference(targets, t, sources, no_self);
    const long double rounded = tolerance<double>(acceleration, exact, sources.count()) / step;
    return 1.01L * (4 * step * step * curvature + rounded) + tolerance<double>(tide, exact, sources.count());
}

// The step and the places are short binary fractions: moving a target rounds nothing.
TEST(GravityTide, IsTheDerivativeOfTheAcceleration)
{
    constexpr std::array<std::array<Component, 3>, 3> entry = {
        {{Txx, Txy, Txz}, {Txy, Tyy, Tyz}, {Txz, Tyz, Tzz}}};
    const auto targets = random_bodies<double>(16, 1);
    auto sources = random_bodies<double>(50, 2);
    for (double& x : sources.x)
        x += x < 0 ? -1.5 : 1.5;
    const auto tide = evaluate(kernels(), targets, sources, no_self);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto ahead = targets, behind = targets;
        const auto moved = std::array{&Bodies<double>::x, &Bodies<double>::y, &Bodies<double>::z}[axis];
        for (std::size_t t = 0; t < targets.count(); ++t) {
            (ahead.*moved)[t] += step;
            (behind.*moved)[t] -= step;
        }
        const auto more = evaluate(kernels(), ahead, sources, no_self);
        const auto less = evaluate(kernels(), behind, sources, no_self);
        for (std::size_t t = 0; t < targets.count(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                const double slope = (more[Ax + i][t] - less[Ax + i][t]) / (2 * step);
                EXPECT_LE(std::abs(slope - tide[entry[i][axis]][t]),
                          slope_tolerance(targets, t, sources, Ax + i, entry[i][axis]))
                    << component_names[entry[i][axis]] << " of target " << t;
            }
        }
    }
}

// The exact trace is zero; what is left is the three entries' rounding.
TYPED_TEST(GravityKernel, TideHasNoTraceWithoutSoftening)
{
    auto targets = random_bodies<TypeParam>(16, 1);
    auto sources = random_bodies<TypeParam>(60, 2);
    targets.q.assign(targets.count(), 0);
    sources.q.assign(sources.count(), 0);
    for (const KernelTable* table : runnable_kernels()) {
        const auto sums = evaluate(*table, targets, sources, no_self);
        for (std::size_t t = 0; t < targets.count(); ++t) {
            const Reference exact = reference(targets, t, sources, no_self);
            long double trace = 0, bound = 0;
            for (const std::size_t c : {Txx, Tyy, Tzz}) {
                trace += sums[c][t];
                bound += tolerance<TypeParam>(c, exact, sources.count());
            }
            EXPECT_LE(std::abs(trace), bound) << table->name << ", target " << t;
        }
    }
}

} // namespace
} // namespace slod::simd
