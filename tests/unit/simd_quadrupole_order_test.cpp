#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "unit/simd_quadrupole_support.hpp"

// What a node with second moments misses of its parts, and its tide.
namespace slod::simd {
namespace {

/// Of one node and one target at the origin, in double: what the node misses of its points, as the norms of
/// acceleration and tide.
std::array<double, 2> missed(const std::vector<PointMass>& points, const std::array<double, 3>& centre,
                             double q, double scale)
{
    std::vector<PointMass> scaled = points;
    for (PointMass& point : scaled)
        for (double& coordinate : point.offset)
            coordinate *= scale;
    Rows<double> targets, node, parts;
    while (targets.count() < tile_width)
        targets.add({});
    node.add(node_of(scaled, centre, q));
    for (const PointMass& point : scaled)
        parts.add({centre[0] + point.offset[0], centre[1] + point.offset[1], centre[2] + point.offset[2], q,
                   point.mass});
    const auto whole = evaluate_nodes(kernels(), targets, node.nodes());
    const auto exact = evaluate_nodes(kernels(), targets, parts.nodes());
    std::array<double, 2> squares{};
    for (std::size_t c = 0; c < sum_count; ++c)
        squares[c < 3 ? 0 : 1] += std::pow(whole[c][0] - exact[c][0], 2);
    return {std::sqrt(squares[0]), std::sqrt(squares[1])};
}

// What is missing is of third order in the size: an eighth at half of it. The fourth order is smaller by
// size / distance times 5/4 for the acceleration and 6/4 for the tide; times 4, for directions in which the
// third is small. A wrong coefficient leaves second order, a quarter, and the tide's would not follow.
TEST(QuadrupoleKernelOrder, OfANodesPartsOnlyTheThirdOrderIsMissing)
{
    constexpr double size = 0.01;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::mt19937_64 bits(seed);
        const std::vector<PointMass> points = random_points(bits, size);
        for (const double q : {0.0, 0.3}) {
            const auto coarse = missed(points, {0.8, -0.5, 0.6}, q, 1);
            const auto fine = missed(points, {0.8, -0.5, 0.6}, q, 0.5);
            for (const std::size_t of : {0U, 1U})
                EXPECT_NEAR(coarse[of] / fine[of], 8, 8 * 4 * 1.5 * size)
                    << (of == 0 ? "acceleration" : "tide") << ", seed " << seed << ", q " << q;
        }
    }
}

/// How far central differences of the acceleration by one node over 2 `step` are from its tide, in norm.
double slope_error(const Rows<double>& node, double step)
{
    Rows<double> targets;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {step, -step}) {
            std::array<double, column_count> row{};
            row[axis] = side;
            targets.add(row);
        }
    }
    while (targets.count() < tile_width)
        targets.add({});
    const auto sums = evaluate_nodes(kernels(), targets, node.nodes());
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < 3; ++i)
            squares += std::pow(
                (sums[i][2 * axis] - sums[i][2 * axis + 1]) / (2 * step) - sums[entry[i][axis]].back(), 2);
    return std::sqrt(squares);
}

// A central difference misses step^2 / 6 of the third derivative and step^4 / 120 of the fifth, which for a
// pull that falls as d^-4 is 56 / d^2 of it: 2.8 step^2 of the error, times 20 for directions in which the
// third is small. A tide that is not the derivative leaves a part that does not fall.
TEST(QuadrupoleKernelTide, IsTheDerivativeOfTheAcceleration)
{
    constexpr double step = 0x1p-6;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::mt19937_64 bits(seed);
        for (const double q : {0.0, 0.3}) {
            Rows<double> node;
            node.add(node_of(random_points(bits, 0.7), {0.8, -0.5, 0.6}, q));
            EXPECT_NEAR(slope_error(node, step) / slope_error(node, step / 2), 4, 4 * 20 * 2.8 * step * step)
                << "seed " << seed << ", q " << q;
        }
    }
}

} // namespace
} // namespace slod::simd
