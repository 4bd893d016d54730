#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/simd_gravity_support.hpp"

// The kernels of nodes with second moments. What they share with those of points is tested with those.
namespace slod::simd {
namespace {

constexpr std::size_t sum_count = 9; ///< three of the acceleration, six of the tide
constexpr std::array<std::array<std::size_t, 3>, 3> entry = {{{3, 4, 5}, {4, 6, 7}, {5, 7, 8}}};

using Vector = std::array<long double, 3>;

/// Columns of targets or of nodes: x, y, z, q, and of nodes mass, the six moments and their trace.
enum Column : std::size_t { X, Y, Z, Q, Mass, Xx, Xy, Xz, Yy, Yz, Zz, Trace, column_count };

template <class Real>
struct Rows {
    std::array<std::vector<Real>, column_count> columns;

    std::size_t count() const { return columns[X].size(); }
    const Real* data(Column column) const { return columns[column].data(); }

    void add(const std::array<double, column_count>& row)
    {
        for (std::size_t column = 0; column < column_count; ++column)
            columns[column].push_back(Real(row[column]));
    }

    GravityNodes<Real> nodes() const
    {
        return {{count(), data(X), data(Y), data(Z), data(Mass), data(Q)},
                data(Xx),
                data(Xy),
                data(Xz),
                data(Yy),
                data(Yz),
                data(Zz),
                data(Trace)};
    }
};

struct PointMass {
    std::array<double, 3> offset; ///< from the centre of mass
    double mass;
};

/// The node that these are, with its centre of mass there.
std::array<double, column_count> node_of(const std::vector<PointMass>& points,
                                         const std::array<double, 3>& centre, double q)
{
    std::array<double, column_count> row{centre[0], centre[1], centre[2], q};
    for (const PointMass& point : points)
        row[Mass] += point.mass;
    for (const PointMass& point : points) {
        const double share = 3 * point.mass / row[Mass];
        std::size_t moment = Xx;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = i; j < 3; ++j)
                row[moment++] += share * point.offset[i] * point.offset[j];
    }
    row[Trace] = 0.5 * (row[Xx] + row[Yy] + row[Zz]);
    return row;
}

/// Three masses of 1/2 to 3/2 that reach `size` from their centre of mass, about.
std::vector<PointMass> random_points(std::mt19937_64& bits, double size)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<PointMass> points(3);
    std::array<double, 3> centre{};
    double mass = 0;
    for (PointMass& point : points) {
        point.mass = 1 + 0.5 * uniform(bits);
        mass += point.mass;
        for (std::size_t i = 0; i < 3; ++i) {
            point.offset[i] = size * uniform(bits);
            centre[i] += point.mass * point.offset[i];
        }
    }
    for (PointMass& point : points)
        for (std::size_t i = 0; i < 3; ++i)
            point.offset[i] -= centre[i] / mass;
    return points;
}

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

template <class Real>
using NodeSums = std::array<std::vector<Real>, sum_count>;

template <class Real>
NodeSums<Real> evaluate_nodes(const KernelTable& table, const Rows<Real>& targets,
                              const GravityNodes<Real>& nodes, bool tide = true)
{
    NodeSums<Real> sums;
    for (std::vector<Real>& sum : sums)
        sum.assign(targets.count(), 0);
    GravityTargets<Real> pulled{targets.count(), targets.data(X), targets.data(Y), targets.data(Z),
                                targets.data(Q), sums[0].data(),  sums[1].data(),  sums[2].data(),
                                sums[3].data(),  sums[4].data(),  sums[5].data(),  sums[6].data(),
                                sums[7].data(),  sums[8].data()};
    const GravityKernels<Real>& kernels = gravity_kernels<Real>(table);
    if (tide) {
        kernels.add_nodes_acceleration_and_tide(pulled, nodes);
    } else {
        pulled.txx = pulled.txy = pulled.txz = pulled.tyy = pulled.tyz = pulled.tzz = nullptr;
        kernels.add_nodes_acceleration(pulled, nodes);
    }
    return sums;
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

template <class Real>
void expect_definition(const KernelTable& table, std::size_t target_count, std::size_t node_count)
{
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
            ASSERT_LE(std::abs(sums[c][t] - expected.sum[c]), bound)
                << table.name << ", component " << c << " of target " << t << " of " << target_count << " by "
                << node_count;
        }
    }
}

template <class Real>
class QuadrupoleKernel : public testing::Test {};

TYPED_TEST_SUITE(QuadrupoleKernel, Precisions, PrecisionNames);

TYPED_TEST(QuadrupoleKernel, SumsWhatTheDefinitionSays)
{
    for (const KernelTable* table : runnable_kernels())
        for (const std::size_t target_count : {1U, 15U, 16U, 33U})
            for (std::size_t node_count = 0; node_count <= 40; ++node_count)
                expect_definition<TypeParam>(*table, target_count, node_count);
}

TYPED_TEST(QuadrupoleKernel, HasTheSameBitsOnEveryInstructionSetWithAndWithoutTheTide)
{
    for (std::uint64_t seed = 0; seed < 32; ++seed) {
        SCOPED_TRACE(seed);
        const auto targets = random_targets<TypeParam>(1 + 3 * seed, seed);
        const auto nodes = random_nodes<TypeParam>(5 * seed, seed + 1000);
        const auto baseline = evaluate_nodes(*kernels("baseline"), targets, nodes.nodes());
        for (const KernelTable* table : runnable_kernels()) {
            for (const bool tide : {true, false}) {
                const auto sums = evaluate_nodes(*table, targets, nodes.nodes(), tide);
                for (std::size_t c = 0; c < (tide ? sum_count : 3); ++c)
                    ASSERT_EQ(
                        std::memcmp(sums[c].data(), baseline[c].data(), sums[c].size() * sizeof(TypeParam)),
                        0)
                        << table->name << ", component " << c << (tide ? "" : " without the tide");
            }
        }
    }
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
