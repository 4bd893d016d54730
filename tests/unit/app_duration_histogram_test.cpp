#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "app/duration_histogram.hpp"
#include "core/random.hpp"
#include "support/random_draws.hpp"

namespace slod {
namespace {

// A bucket above 128 ns is at most 1/64 of its lower edge wide and its middle stands for it, so a quantile is
// within 1/128 of the exact one of the same rank. Below 1 us, single nanoseconds are dropped: 1e-6 ms more.
TEST(DurationHistogram, QuantilesAreThoseOfTheSortedListToOnePartIn128)
{
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        SCOPED_TRACE(seed);
        DurationHistogram histogram;
        std::vector<double> all;
        Random random(seed, 0, 0);
        for (int i = 0; i < 999; ++i) {
            all.push_back(std::pow(10, random_normal(random) * 2)); // 1 ns to hours
            histogram.add(all.back());
        }
        std::sort(all.begin(), all.end());
        for (const double share : {0.001, 0.01, 0.5, 0.9, 0.99, 1.0}) {
            const double exact = all[std::size_t(std::ceil(share * double(all.size()))) - 1];
            EXPECT_NEAR(histogram.quantile(share), exact, exact / 128 + 1e-6) << "share " << share;
        }
    }
}

TEST(DurationHistogram, NearestRankTakesTheSmallerOfTwoMiddles)
{
    DurationHistogram histogram;
    for (const double milliseconds : {1.0, 2.0, 3.0, 100.0})
        histogram.add(milliseconds);
    EXPECT_NEAR(histogram.quantile(0.5), 2, 2.0 / 128);
    EXPECT_NEAR(histogram.quantile(0.99), 100, 100.0 / 128);
    EXPECT_EQ(histogram.count(), 4U);
}

TEST(DurationHistogram, ExtremesAreCountedAndNothingIsZero)
{
    DurationHistogram histogram;
    EXPECT_EQ(histogram.quantile(0.5), 0);
    histogram.add(-1);
    EXPECT_EQ(histogram.quantile(0.5), 0);
    histogram.add(1e300);
    EXPECT_EQ(histogram.count(), 2U);
    EXPECT_GT(histogram.quantile(1), 1e11); // thirty years are 1e12 ms
}

} // namespace
} // namespace slod
