#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "idl/duration_histogram.hpp"
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

TEST(DurationHistogram, HistogramsOfPartsAddUpToThatOfTheWhole)
{
    DurationHistogram whole, odd, even;
    for (int i = 0; i < 1000; ++i) {
        whole.add(0.1 * i);
        (i % 2 ? odd : even).add(0.1 * i);
    }
    odd.add(even);
    EXPECT_EQ(odd.counts(), whole.counts());
    EXPECT_EQ(odd.count(), 1000U);
}

TEST(DurationHistogram, TravelsAsCountsThatAreNotZero)
{
    DurationHistogram histogram;
    for (const double milliseconds : {0.0, 3.0, 3.0, 1e300})
        histogram.add(milliseconds);
    const DurationHistogram::Counts counts = histogram.counts();
    EXPECT_EQ(counts.size(), 3U);
    const DurationHistogram arrived(counts);
    EXPECT_EQ(arrived.counts(), counts);
    EXPECT_EQ(arrived.count(), 4U);
    EXPECT_EQ(arrived.quantile(0.5), histogram.quantile(0.5));
    const DurationHistogram::Counts beyond{{counts.rbegin()->first + 1, 1}};
    EXPECT_THROW(DurationHistogram{beyond}, std::out_of_range);
}

} // namespace
} // namespace slod
