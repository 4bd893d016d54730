#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/portable_math.hpp"
#include "core/random.hpp"

namespace slod {
namespace {

constexpr int samples = 100'000;
constexpr double documented = 4e-16; ///< of portable_math.hpp; the long double reference is good to 1e-19
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Range {
    double lower, upper;
};

template <class Function, class Reference>
void expect_close(const Range& range, const Function& function, const Reference& reference)
{
    Random random(1, 0, 0);
    for (int i = 0; i < samples; ++i) {
        const double x = range.lower + (range.upper - range.lower) * random.uniform();
        const long double exact = reference(static_cast<long double>(x));
        const long double error = std::abs((function(x) - exact) / exact);
        ASSERT_LE(error, documented) << "at " << x;
    }
}

long double exact_exp(long double x)
{
    return std::exp(x);
}

long double exact_expm1(long double x)
{
    return std::expm1(x);
}

TEST(PortableExp, IsWithinItsBoundOverTheWholeRangeOfNormalResults)
{
    for (const Range range : {Range{-708.39, 709.78}, Range{-1, 1}, Range{-0.4, 0.4}, Range{-1e-3, 1e-3}})
        expect_close(range, portable_exp, exact_exp);
}

TEST(PortableExp, HasItsLimits)
{
    EXPECT_EQ(portable_exp(0), 1);
    EXPECT_EQ(portable_exp(-infinity), 0);
    EXPECT_EQ(portable_exp(-1e308), 0);
    EXPECT_EQ(portable_exp(infinity), infinity);
    EXPECT_EQ(portable_exp(710), infinity);
    EXPECT_TRUE(std::isnan(portable_exp(std::numeric_limits<double>::quiet_NaN())));
    // The last number whose exponential is finite: log(2^1024 (1 - 2^-53)).
    const double last = 709.78271289338397;
    EXPECT_NEAR(portable_exp(last) / std::exp(last), 1, documented);
}

// Below 2^-1022 results have fewer bits; the error is within the last of them.
TEST(PortableExp, LosesOnlyTheBitsThatSmallResultsLack)
{
    for (double x = -745; x < -708.4; x += 0.01)
        EXPECT_LE(std::abs(portable_exp(x) - exact_exp(x)), 4.95e-324L) << "at " << x;
}

// Around +-0.35 the reduction by ln 2 sets in: a difference of near numbers would lose bits there.
TEST(PortableExpm1, IsWithinItsBoundOverTheWholeRangeOfNormalResults)
{
    for (const Range range : {Range{-700, 700}, Range{-45, 45}, Range{-2, 2}, Range{0.34, 0.36},
                              Range{-0.36, -0.34}, Range{-1e-3, 1e-3}, Range{-1e-200, 1e-200}})
        expect_close(range, portable_expm1, exact_expm1);
}

TEST(PortableExpm1, HasItsLimits)
{
    EXPECT_EQ(portable_expm1(0), 0);
    EXPECT_EQ(portable_expm1(-infinity), -1);
    EXPECT_EQ(portable_expm1(infinity), infinity);
    EXPECT_EQ(portable_expm1(-41), -1);
    EXPECT_TRUE(std::isnan(portable_expm1(std::numeric_limits<double>::quiet_NaN())));
}

// Near 1 the relative error is against a small logarithm.
TEST(PortableLog, IsWithinItsBoundOverTheWholeRange)
{
    const auto exact = [](long double x) { return std::log(x); };
    for (const Range range : {Range{0.5, 2}, Range{0.70, 0.72}, Range{1.40, 1.43}, Range{0.999, 1.001},
                              Range{1e-308, 1e-300}, Range{1, 1e300}, Range{5e-324, 1e-310}})
        expect_close(range, portable_log, exact);
    EXPECT_EQ(portable_log(1), 0);
}

TEST(PortableLog, UndoesTheExponential)
{
    // exp turns an error d of its argument into a relative one of d: 700 eps and the bounds of both.
    for (double x = -700; x <= 700; x += 0.37)
        EXPECT_NEAR(portable_log(portable_exp(x)), x, 700 * 2.3e-16 + documented) << "at " << x;
}

TEST(PortableSincos, IsWithinItsBoundUpToAHundredThousand)
{
    Random random(2, 0, 0);
    for (const double reach : {1e5, 100.0, 4.0, 1e-3}) {
        for (int i = 0; i < samples; ++i) {
            const double angle = reach * (2 * random.uniform() - 1);
            const SineCosine found = portable_sincos(angle);
            ASSERT_LE(std::abs(found.sine - std::sin(static_cast<long double>(angle))), documented) << angle;
            ASSERT_LE(std::abs(found.cosine - std::cos(static_cast<long double>(angle))), documented)
                << angle;
        }
    }
}

TEST(PortableSincos, IsExactAtZeroAndKeepsTheQuadrants)
{
    EXPECT_EQ(portable_sincos(0).sine, 0);
    EXPECT_EQ(portable_sincos(0).cosine, 1);
    constexpr std::array sines = {0, 1, 0, -1};
    constexpr double rounding_of_angle = 9e-16; // half the last bit of 12.6
    for (int quarter = -8; quarter <= 8; ++quarter) {
        const SineCosine found = portable_sincos(quarter * 1.5707963267948966);
        EXPECT_NEAR(found.sine, sines[std::size_t(quarter & 3)], rounding_of_angle + documented);
        EXPECT_NEAR(found.cosine, sines[std::size_t((quarter + 1) & 3)], rounding_of_angle + documented);
    }
}

} // namespace
} // namespace slod
