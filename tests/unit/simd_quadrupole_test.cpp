#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "unit/simd_quadrupole_support.hpp"

// The kernels of nodes with second moments. What they share with those of points is tested with those.
namespace slod::simd {
namespace {

using Vector = std::array<long double, 3>;

/// Within 1/4 of the origin; padded with targets at the origin.
template <class Real>
Rows<Real> random_targets(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 bits(seed);
    std::uniform_real_distribution<double> uniform(-0.25, 0.25);
    Rows<Real> targets;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = uniform(bits), y = uniform(bits), z = uniform(bits);
        targets.add({x, y, z, i % 4 == 3 ? 0 : 0.01 * std::abs(uniform(bits))});
    }
    while (targets.count() % tile_width != 0)
        targets.add({});
    return targets;
}

/// At distances from 1 to 3 of any target's x, of sizes up to 0.9.
template <class Real>
Rows<Real> random_nodes(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 bits(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Rows<Real> nodes;
    for (std::size_t i = 0; i < count; ++i) {
        const double along = 1.5 * uniform(bits), y = uniform(bits), z = uniform(bits);
        const double x = along < 0 ? along - 1.25 : along + 1.25;
        const auto points = random_points(bits, 0.5 * std::abs(uniform(bits)));
        nodes.add(node_of(points, {x, y, z}, i % 3 == 2 ? 0 : 0.01 * std::abs(uniform(bits))));
    }
    return nodes;
}

/// The definition, in long double: each component's sum, and the sum of its terms' magnitudes.
struct NodeTerms {
    std::array<long double, sum_count> sum{}, magnitude{};

    void add(std::size_t component, long double term, long double size)
    {
        sum[component] += term;
        magnitude[component] += std::abs(size);
    }
    void add(std::size_t component, long double term) { add(component, term, term); }
};

/// One node's terms of a pair: the acceleration and its derivative, power by power of 1 / r.
template <class Real>
void add_pair(NodeTerms& result, const Rows<Real>& targets, std::size_t t, const Rows<Real>& nodes,
              std::size_t s)
{
    const auto exact = [](Real value) { return static_cast<long double>(value); };
    const auto of = [&](Column column) { return exact(nodes.columns[column][s]); };
    const Vector d = {of(X) - exact(targets.columns[X][t]), of(Y) - exact(targets.columns[Y][t]),
                      of(Z) - exact(targets.columns[Z][t])};
    const std::array<Vector, 3> moments = {
        {{of(Xx), of(Xy), of(Xz)}, {of(Xy), of(Yy), of(Yz)}, {of(Xz), of(Yz), of(Zz)}}};
    Vector w{}, w_size{}; // 3 s d
    long double along = 0, along_size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            w[i] += moments[i][j] * d[j];
            w_size[i] += std::abs(moments[i][j] * d[j]);
        }
        along += 2.5L * d[i] * w[i];
        along_size += 2.5L * std::abs(d[i]) * w_size[i];
    }
    const long double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + exact(targets.columns[Q][t]) + of(Q);
    const long double m3 = of(Mass) / (square * std::sqrt(square)), m5 = m3 / square, m7 = m5 / square;
    const long double m9 = m7 / square, trace = of(Trace);
    for (std::size_t i = 0; i < 3; ++i) {
        result.add(i, m3 * d[i]);
        result.add(i, m7 * along * d[i], m7 * along_size * d[i]);
        result.add(i, -m5 * trace * d[i]);
        result.add(i, -m5 * w[i], m5 * w_size[i]);
        for (std::size_t j = i; j < 3; ++j) {
            const std::size_t c = entry[i][j];
            const long double dd = d[i] * d[j];
            result.add(c, 3 * m5 * dd);
            result.add(c, m5 * moments[i][j]);
            result.add(c, -5 * m7 * (w[i] * d[j] + w[j] * d[i]),
                       5 * m7 * (w_size[i] * std::abs(d[j]) + w_size[j] * std::abs(d[i])));
            result.add(c, 7 * m9 * along * dd, 7 * m9 * along_size * dd);
            result.add(c, -5 * m7 * trace * dd);
            if (i != j)
                continue;
            result.add(c, -m3);
            result.add(c, m5 * trace);
            result.add(c, -m7 * along, m7 * along_size);
        }
    }
}

/// Roundings of one term, to first order, of which half a step is spare. As in simd_gravity_support.hpp d has
/// 1, 1 / r^2 7 and m / r^3 13.5. Then 3 s d / r^2 has 4 + 7 + 1, along 2 + 2 + 8 + 1 more, the factor 2
/// more, times d 29, less 3 s d / r^2 30, times the pull 44.5. Of the tide v is of along, 25, and 1 + 2 for
/// the bracket, 2 for d, 1 for 3 s d / r^2 and 8 for 1 / r^2, 39; times d and two terms more 44, times the
/// pull 58.5.
double node_roundings(std::size_t component)
{
    return component < 3 ? 45 : 59;
}

/// The largest error of a sum, in what roundings may make of it.
template <class Real>
double largest_error(const KernelTable& table, std::size_t target_count, std::size_t node_count)
{
    double largest = 0;
    const auto targets = random_targets<Real>(target_count, 2 * target_count);
    const auto nodes = random_nodes<Real>(node_count, 2 * node_count + 1);
    const auto sums = evaluate_nodes(table, targets, nodes.nodes());
    for (std::size_t t = 0; t < target_count; ++t) {
        NodeTerms expected;
        for (std::size_t s = 0; s < node_count; ++s)
            add_pair(expected, targets, t, nodes, s);
        for (std::size_t c = 0; c < sum_count; ++c) {
            const long double bound = (node_roundings(c) + double(node_count)) *
                                      std::numeric_limits<Real>::epsilon() / 2 * expected.magnitude[c];
            const long double error = std::abs(sums[c][t] - expected.sum[c]);
            const double share = error == 0 ? 0 : double(error / bound);
            EXPECT_LE(share, 1) << table.name << ", component " << c << " of target " << t << " of "
                                << target_count << " by " << node_count;
            largest = std::max(largest, share);
        }
    }
    return largest;
}

template <class Real>
class QuadrupoleKernel : public testing::Test {};

TYPED_TEST_SUITE(QuadrupoleKernel, Precisions, PrecisionNames);

TYPED_TEST(QuadrupoleKernel, N23_SumsWhatTheDefinitionSays)
{
    double largest = 0;
    for (const KernelTable* table : runnable_kernels())
        for (const std::size_t target_count : {1U, 15U, 16U, 33U})
            for (std::size_t node_count = 0; node_count <= 65; ++node_count)
                largest = std::max(largest, largest_error<TypeParam>(*table, target_count, node_count));
    test::expect_at_most("largest error, in that of all its roundings", largest, 1);
}

TYPED_TEST(QuadrupoleKernel, N12_HasTheSameBitsOnEveryInstructionSetWithAndWithoutTheTide)
{
    int others = 0;
    for (std::uint64_t seed = 0; seed < 32; ++seed) {
        SCOPED_TRACE(seed);
        const auto targets = random_targets<TypeParam>(1 + 3 * seed, seed);
        const auto nodes = random_nodes<TypeParam>(5 * seed, seed + 1000);
        const auto baseline = evaluate_nodes(*kernels("baseline"), targets, nodes.nodes());
        for (const KernelTable* table : runnable_kernels()) {
            for (const bool tide : {true, false}) {
                const auto sums = evaluate_nodes(*table, targets, nodes.nodes(), tide);
                for (std::size_t c = 0; c < (tide ? sum_count : 3); ++c) {
                    const bool same = std::memcmp(sums[c].data(), baseline[c].data(),
                                                  sums[c].size() * sizeof(TypeParam)) == 0;
                    EXPECT_TRUE(same)
                        << table->name << ", component " << c << (tide ? "" : " without the tide");
                    others += same ? 0 : 1;
                }
            }
        }
    }
    test::expect_at_most("sums with other bits", others, 0);
}

// Without extent a node is a point: the same terms, added to ones that are zero.
TYPED_TEST(QuadrupoleKernel, ANodeWithoutExtentPullsAsAPoint)
{
    const auto targets = random_targets<TypeParam>(33, 1);
    auto nodes = random_nodes<TypeParam>(20, 2);
    for (std::size_t column = Xx; column <= Trace; ++column)
        nodes.columns[column].assign(nodes.count(), 0);
    const auto sums = evaluate_nodes(kernels(), targets, nodes.nodes(), false);
    NodeSums<TypeParam> points;
    for (std::vector<TypeParam>& sum : points)
        sum.assign(targets.count(), 0);
    gravity_kernels<TypeParam>(kernels()).add_acceleration(
        {targets.count(), targets.data(X), targets.data(Y), targets.data(Z), targets.data(Q),
         points[0].data(), points[1].data(), points[2].data(), nullptr, nullptr, nullptr, nullptr, nullptr,
         nullptr},
        nodes.nodes(), no_self);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(sums[c], points[c]);
}

// Lengths at both ends of what the units allow, 1e-12 and 1e12: the seventh power of neither is a float.
TEST(QuadrupoleKernelRange, NoPowerOfADistanceOverflows)
{
    for (const double length : {1e-12, 1e12}) {
        std::mt19937_64 bits(1);
        const std::vector<PointMass> points = random_points(bits, 0.2);
        Rows<float> targets, nodes, unit_nodes;
        targets.add({});
        while (targets.count() < tile_width)
            targets.add({});
        unit_nodes.add(node_of(points, {1, 0.5, -0.5}, 0.01));
        auto row = node_of(points, {length, 0.5 * length, -0.5 * length}, 0.01 * length * length);
        for (std::size_t column = Xx; column <= Trace; ++column)
            row[column] *= length * length;
        row[Mass] *= std::min(1.0, std::pow(length, 2)); // so that the pull is a float itself
        nodes.add(row);
        const auto scaled = evaluate_nodes(kernels(), targets, nodes.nodes());
        NodeTerms expected;
        add_pair(expected, targets, 0, unit_nodes, 0);
        for (std::size_t c = 0; c < sum_count; ++c) {
            const double unit = std::pow(length, c < 3 ? -2 : -3) * std::min(1.0, std::pow(length, 2));
            // Scaling rounds places, q, moments and mass, which a term takes at most nine times.
            EXPECT_LE(std::abs(scaled[c][0] / unit - expected.sum[c]),
                      (node_roundings(c) + 9) * 0x1p-24 * expected.magnitude[c])
                << "length " << length << ", component " << c;
        }
    }
}

} // namespace
} // namespace slod::simd
