#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "meter/error_window.hpp"
#include "meter/order_statistics.hpp"

namespace slod {
namespace {

/// Probability of each number of n draws that fall below the q-quantile.
std::vector<double> binomial(double q, std::size_t n)
{
    std::vector<double> row{1};
    for (std::size_t draw = 0; draw < n; ++draw) {
        std::vector<double> next(row.size() + 1, 0);
        for (std::size_t k = 0; k < row.size(); ++k) {
            next[k] += (1 - q) * row[k];
            next[k + 1] += q * row[k];
        }
        row = next;
    }
    return row;
}

/// Probability that the quantile is between the values of these ranks, and at them.
double coverage(const QuantileRanks& ranks, double q, std::size_t n)
{
    const std::vector<double> below = binomial(q, n);
    double sum = 0;
    for (std::size_t k = ranks.low + 1; k <= ranks.high; ++k)
        sum += below[k];
    return sum;
}

TEST(QuantileRanks, HoldTheQuantileWithTheProbabilityAndNoFewerWould)
{
    for (const double q : {0.5, 0.9, 0.99}) {
        for (const std::size_t n : {20, 60, 200, 500, 1024}) {
            SCOPED_TRACE(testing::Message() << q << " of " << n);
            const QuantileRanks ranks = ranks_around(q, n);
            if (std::pow(q, double(n)) > 0.025) { // so often all values are below
                EXPECT_EQ(ranks.high, n - 1);
                continue;
            }
            EXPECT_GE(coverage(ranks, q, n), 0.95);
            EXPECT_LT(coverage({ranks.low + 1, ranks.high - 1}, q, n), 0.95);
        }
    }
}

TEST(QuantileRanks, OfFewValuesAreTheFirstAndTheLast)
{
    for (const std::size_t n : {1, 2, 3}) {
        EXPECT_EQ(ranks_around(0.5, n).low, 0U);
        EXPECT_EQ(ranks_around(0.5, n).high, n - 1);
    }
    EXPECT_EQ(ranks_around(0.99, 100).high, 99U);
}

TEST(ErrorWindow, KnowsNothingWithoutSamples)
{
    EXPECT_EQ(ErrorWindow(8).estimate().samples, 0U);
}

TEST(ErrorWindow, GivesQuantilesOfTheNewestSamples)
{
    ErrorWindow window(1000);
    for (std::uint64_t frame = 1; frame <= 3000; ++frame)
        window.add({frame, double(frame % 1000 + (frame <= 2000 ? 5000 : 0))});
    const ErrorEstimate estimate = window.estimate(); // of 0 to 999
    EXPECT_EQ(estimate.samples, 1000U);
    EXPECT_EQ(estimate.oldest_frame, 2001U);
    EXPECT_EQ(estimate.newest_frame, 3000U);
    EXPECT_EQ(estimate.median.value, 500);
    EXPECT_EQ(estimate.p90.value, 900);
    EXPECT_EQ(estimate.p99.value, 990);
    EXPECT_EQ(estimate.max, 999);
    EXPECT_NEAR(estimate.rms, std::sqrt(999 * 1999 / 6.0), 1e-9);
    EXPECT_NEAR(estimate.median.low, 500 - 1.96 * std::sqrt(250), 2);
    EXPECT_NEAR(estimate.median.high, 500 + 1.96 * std::sqrt(250), 2);
}

} // namespace
} // namespace slod
