#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simd/kernels.hpp"

// Which nodes act as one body: the formulas of OpeningTerms, in plain double, beside the kernels.
namespace slod::simd {
namespace {

constexpr std::size_t node_count = 4096;

template <class Real>
struct Nodes {
    std::array<std::vector<Real>, 7> columns; // x, y, z, mass, q, radius, blur

    Nodes()
    {
        std::mt19937_64 bits(5);
        std::uniform_real_distribution<double> uniform(0, 1);
        const auto power = [&](double least, double most) {
            return Real(least * std::pow(most / least, uniform(bits)));
        };
        for (std::size_t node = 0; node < node_count; ++node) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                columns[axis].push_back((uniform(bits) < 0.5 ? -1 : 1) * power(0.01, 10));
            columns[3].push_back(node % 50 == 0 ? Real(0) : power(1e-6, 1));
            columns[4].push_back(node % 40 == 0 ? Real(0) : power(1e-6, 0.1));
            columns[5].push_back(node % 30 == 0 ? Real(0) : power(1e-3, 3));
            columns[6].push_back(node % 3 == 0 && columns[4].back() > 0 ? power(1e-3, 0.3) : Real(0));
        }
    }

    NodesInQuestion<Real> list() const
    {
        return {node_count,        columns[0].data(), columns[1].data(), columns[2].data(),
                columns[3].data(), columns[4].data(), columns[5].data(), columns[6].data()};
    }
};

template <class Real>
OpeningTerms<Real> terms(bool relative)
{
    const Real none = std::numeric_limits<Real>::quiet_NaN(), any = Real(1e30), error = Real(1e-3);
    OpeningTerms<Real> terms{};
    terms.lower[0] = terms.lower[1] = terms.lower[2] = Real(-0.1);
    terms.upper[0] = terms.upper[1] = terms.upper[2] = Real(0.2);
    terms.reach = Real(0.25);
    terms.q = Real(1e-3);
    terms.q_spread = Real(1e-4);
    terms.guard = relative ? Real(0.81) : Real(0.25);
    terms.far_guard = relative ? Real(0.81) : none;
    terms.most_blur = relative ? any : Real(0.25);
    terms.error = relative ? error : any;
    terms.point_error = relative ? error / 2 : none;
    terms.extended_error = relative ? 4 * error : any;
    terms.far_error = 2 * error;
    return terms;
}

/// By how much a bound is kept, as a share of it; infinite where it is excluded or without meaning.
double slack(double value, double bound)
{
    return bound > 0 ? 1 - value / bound : value <= bound ? 1 : -1;
}

/// The role, or none where some bound is within rounding of its value.
int role_by_the_formula(const Nodes<float>& nodes, std::size_t node, const OpeningTerms<float>& t)
{
    const auto of = [&](std::size_t column) { return double(nodes.columns[column][node]); };
    const double m = of(3), q = of(4), r = of(5), b = of(6);
    double squared = 0, from_box = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = of(axis);
        const double gap = std::max({double(t.lower[axis]) - x, x - double(t.upper[axis]), 0.0});
        squared += x * x;
        from_box += gap * gap;
    }
    const double tf = squared + q + double(t.q), tb = from_box + q, s = r + double(t.reach);
    bool near = false;
    const auto kept = [&](double value, double bound) {
        near = near || std::abs(slack(value, bound)) < 1e-4;
        return value <= bound;
    };
    const double error = double(t.error);
    const bool far = kept(s * s, double(t.far_guard) * squared) &
                     kept(m * std::pow(s, 4), double(t.far_error) * std::pow(tf, 3)) &
                     kept(m * std::pow(b, 4), error * std::pow(tf, 3)) &
                     kept(1.5 * m * double(t.q_spread), error * tf * tf);
    const bool one = kept(r * r, double(t.guard) * from_box) & kept(b * b, double(t.most_blur) * tb) &
                     kept(m * std::pow(b, 4), error * std::pow(tb, 3));
    const bool point = kept(m * r * r, double(t.point_error) * tb * tb);
    const bool extended = kept(m * std::pow(r, 4), double(t.extended_error) * std::pow(tb, 3)) &
                          kept(m * r * b * b, error * std::pow(tb, 2.5));
    if (near)
        return -1;
    const NodeRole role = far        ? NodeRole::Far
                          : !one     ? NodeRole::Opened
                          : point    ? NodeRole::Point
                          : extended ? NodeRole::Extended
                                     : NodeRole::Opened;
    return int(role);
}

template <class Real>
std::vector<std::uint8_t> roles(const KernelTable& table, const OpeningTerms<Real>& asked)
{
    const Nodes<Real> nodes;
    std::vector<std::uint8_t> found(node_count, 0xff);
    gravity_kernels<Real>(table).find_roles(asked, nodes.list(), found.data());
    return found;
}

TEST(OpeningKernel, FindsTheRolesOfTheFormulas)
{
    for (const bool relative : {true, false}) {
        const OpeningTerms<float> asked = terms<float>(relative);
        const std::vector<std::uint8_t> found = roles(kernels(), asked);
        const Nodes<float> nodes;
        std::array<std::size_t, 4> seen{};
        std::size_t compared = 0;
        for (std::size_t node = 0; node < node_count; ++node) {
            const int expected = role_by_the_formula(nodes, node, asked);
            if (expected < 0)
                continue;
            ASSERT_EQ(int(found[node]), expected) << node;
            ++seen[std::size_t(expected)];
            ++compared;
        }
        EXPECT_GT(compared, node_count * 9 / 10);
        EXPECT_GT(seen[0], 100U);
        EXPECT_GT(seen[2], 100U);
        EXPECT_EQ(seen[1] > 100, relative) << "points";
        EXPECT_EQ(seen[3] > 100, relative) << "far";
    }
}

TEST(OpeningKernel, FindsTheSameRolesOnEveryInstructionSet)
{
    for (const KernelTable* table : runnable_kernels()) {
        for (const bool relative : {true, false}) {
            EXPECT_EQ(roles(*table, terms<float>(relative)),
                      roles(*runnable_kernels().front(), terms<float>(relative)));
            EXPECT_EQ(roles(*table, terms<double>(relative)),
                      roles(*runnable_kernels().front(), terms<double>(relative)));
        }
    }
}

} // namespace
} // namespace slod::simd
