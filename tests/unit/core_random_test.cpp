#include <array>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "support/case_rows.hpp"
#include "support/random_draws.hpp"

namespace slod {
namespace {

using Block = std::array<std::uint32_t, 4>;

constexpr int draws = 200'000;
constexpr double sigmas = 5; ///< a right generator is this far off once in two million; the seeds are fixed

/// Standard error of the mean of `draws` numbers of this variance, times `sigmas`.
double tolerance(double variance)
{
    return sigmas * std::sqrt(variance / draws);
}

// The known answers published with Random123 (Salmon et al. 2011), kat_vectors: counter, key, result.
TEST(Philox, GivesThePublishedKnownAnswers)
{
    EXPECT_EQ(philox4x32_10({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox4x32_10({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}),
              (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, DrawsTheBlocksOfItsSeedStreamAndItemInOrder)
{
    Random random(0x1111'2222'3333'4444, 0x5555, 0x6666'7777'8888'9999);
    for (std::uint32_t block = 0; block < 3; ++block)
        for (const std::uint32_t word :
             philox4x32_10({block, 0x5555, 0x8888'9999, 0x6666'7777}, {0x3333'4444, 0x1111'2222}))
            EXPECT_EQ(random.bits(), word) << "block " << block;
}

// Numbers are drawn in one order and in the reverse, by item.
TEST(Random, N17_DiffersBySeedStreamAndItem)
{
    const std::uint32_t first = Random(1, 2, 3).bits();
    EXPECT_EQ(Random(1, 2, 3).bits(), first);
    const std::array others{Random(2, 2, 3), Random(1, 3, 3), Random(1, 2, 4), Random(1 + (1ULL << 32), 2, 3),
                            Random(1, 2, 3 + (1ULL << 32))};
    int alike = 0;
    for (Random other : others)
        alike += other.bits() == first ? 1 : 0;
    test::expect_at_most("other seeds, streams and items with the same number", alike, 0);
    constexpr std::uint64_t items = 1000;
    std::array<std::uint32_t, items> forwards{};
    for (std::uint64_t item = 0; item < items; ++item)
        forwards[item] = Random(1, 2, item).bits();
    int changed = 0;
    for (std::uint64_t item = items; item-- > 0;)
        changed += Random(1, 2, item).bits() == forwards[item] ? 0 : 1;
    test::expect_at_most("numbers that change with the order", changed, 0);
}

TEST(Random, UniformNumbersNeverReach0Or1)
{
    EXPECT_EQ(between_0_and_1(0), 0x1p-53);
    EXPECT_EQ(between_0_and_1(~0ULL), 1 - 0x1p-53);
    EXPECT_LT(between_0_and_1(~0ULL), 1);
    EXPECT_LT(between_0_and_1(0x7fff'ffff'ffff'ffff), 0.5);
    EXPECT_GT(between_0_and_1(0x8000'0000'0000'0000), 0.5);
}

// Moments of the uniform distribution: mean 1/2, variance 1/12; the square has variance 4/45.
TEST(Random, UniformNumbersHaveTheMomentsOfTheUnitInterval)
{
    Random random(1, 0, 0);
    double sum = 0, squares = 0;
    for (int i = 0; i < draws; ++i) {
        const double u = random.uniform();
        sum += u;
        squares += u * u;
    }
    EXPECT_NEAR(sum / draws, 0.5, tolerance(1.0 / 12));
    EXPECT_NEAR(squares / draws, 1.0 / 3, tolerance(4.0 / 45));
}

// Moments 0, 1, 0, 3; the powers have variances 1, 2, 15, 96.
TEST(Random, NormalNumbersHaveTheFirstFourMoments)
{
    Random random(2, 0, 0);
    std::array<double, 5> powers{};
    for (int i = 0; i < draws; ++i) {
        const double x = random_normal(random);
        double power = 1;
        for (double& sum : powers) {
            sum += power;
            power *= x;
        }
    }
    EXPECT_NEAR(powers[1] / draws, 0, tolerance(1));
    EXPECT_NEAR(powers[2] / draws, 1, tolerance(2));
    EXPECT_NEAR(powers[3] / draws, 0, tolerance(15));
    EXPECT_NEAR(powers[4] / draws, 3, tolerance(96));
}

// Components have mean 0, variance 1/3, fourth moment 1/5 and no correlation: x x has variance 4/45, x y
// 1/15.
TEST(Random, DirectionsAreUniformOnTheSphere)
{
    Random random(3, 0, 0);
    std::array<double, 3> mean{}, square{}, product{};
    for (int i = 0; i < draws; ++i) {
        const Vector3d d = random_direction(random);
        ASSERT_NEAR(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-15);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            mean[axis] += d[axis] / draws;
            square[axis] += d[axis] * d[axis] / draws;
            product[axis] += d[axis] * d[(axis + 1) % 3] / draws;
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(mean[axis], 0, tolerance(1.0 / 3));
        EXPECT_NEAR(square[axis], 1.0 / 3, tolerance(4.0 / 45));
        EXPECT_NEAR(product[axis], 0, tolerance(1.0 / 15));
    }
}

// In the unit disc r^2 is uniform in [0, 1], and x^2 has mean 1/4 and variance 1/16; x y has variance 1/24.
TEST(Random, PointsInTheDiscAreUniform)
{
    Random random(4, 0, 0);
    double radius = 0, x2 = 0, xy = 0;
    for (int i = 0; i < draws; ++i) {
        const auto [x, y] = random_point_in_disc(random);
        ASSERT_LE(x * x + y * y, 1);
        radius += (x * x + y * y) / draws;
        x2 += x * x / draws;
        xy += x * y / draws;
    }
    EXPECT_NEAR(radius, 0.5, tolerance(1.0 / 12));
    EXPECT_NEAR(x2, 0.25, tolerance(1.0 / 16));
    EXPECT_NEAR(xy, 0, tolerance(1.0 / 24));
}

} // namespace
} // namespace slod
