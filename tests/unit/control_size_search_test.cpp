#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "control/size_search.hpp"

// What looks for the size at which an error is at its target, on errors without noise: logarithms of the size
// and of the error over its target throughout.
namespace slod::test {
namespace {

using Excess = std::function<double(double size)>;

Excess power(double power)
{
    return [power](double size) { return power * (size - 1); };
}

Excess jump(double at)
{
    return [at](double size) { return size < at ? -0.4 : 0.6; };
}

/// Sizes judged, the first of them `size`, until the error is within a tenth of its target or `most` are.
std::vector<double> judged(SizeSearch& search, const Excess& excess, double size, int most)
{
    std::vector<double> sizes{size};
    while (int(sizes.size()) < most && std::abs(excess(sizes.back())) > 0.1)
        sizes.push_back(search.next(sizes.back(), excess(sizes.back())));
    return sizes;
}

TEST(SizeSearch, FindsTheSizeHoweverSteeplyTheErrorGrows)
{
    for (const double steepness : {0.3, 0.6, 1.0, 2.5, 6.0, 20.0})
        for (const double from : {-1.5, 4.0}) {
            SCOPED_TRACE(testing::Message() << "power " << steepness << " from " << from);
            SizeSearch search;
            const std::vector<double> sizes = judged(search, power(steepness), from, 40);
            EXPECT_LE(std::abs(steepness * (sizes.back() - 1)), 0.1);
            EXPECT_LE(sizes.size(), 14u);
        }
}

TEST(SizeSearch, TurnsByAtMostAFactorOfTwo)
{
    EXPECT_NEAR(SizeSearch().next(3, 10), 3 - 0.7, 1e-15);
    EXPECT_NEAR(SizeSearch().next(3, -10), 3 + 0.7, 1e-15);
}

TEST(SizeSearch, KeepsBelowAJumpAndTriesItEverLessOften)
{
    SizeSearch search;
    double size = 0;
    std::vector<int> above; // judgements at which it was
    for (int i = 0; i < 60'000; ++i) {
        if (size >= 0.537)
            above.push_back(i);
        EXPECT_TRUE(i < 100 || size > 0.537 - 0.02) << size;
        size = search.next(size, jump(0.537)(size));
    }
    ASSERT_GE(above.size(), 4u);
    const std::size_t last = above.size() - 1;
    EXPECT_LE(above.size(), 20u);
    EXPECT_GT(above[last] - above[last - 1], 8000);
    EXPECT_GE(above[last - 1] - above[last - 2], above[last - 2] - above[last - 3]);
    EXPECT_TRUE(search.kept_below_jump());
}

// The error at the lower end stays as it is: nothing but a trial of the upper one shows it.
TEST(SizeSearch, FindsThatAJumpHasGone)
{
    SizeSearch search;
    double size = 0;
    for (int i = 0; i < 5'000; ++i)
        size = search.next(size, jump(0.537)(size));
    EXPECT_LT(size, 0.537);
    for (int i = 0; i < 9'000; ++i)
        size = search.next(size, jump(3)(size));
    EXPECT_GT(size, 2.9);
    EXPECT_LT(size, 3);
}

TEST(SizeSearch, LooksNearByWhereItWasHeldAndWhereAnEndIsContradicted)
{
    SizeSearch held;
    held.held();
    EXPECT_NEAR(held.next(2, 0.5), 2 - 0.05, 1e-15);
    EXPECT_NEAR(held.next(1.95, 0.5), 1.95 - 0.1, 1e-15);

    SizeSearch contradicted;
    contradicted.next(0, -0.5);
    EXPECT_EQ(contradicted.next(0.015, 0.5), 0);
    EXPECT_NEAR(contradicted.next(0, 0.5), -0.05, 1e-15);
}

// As while a galaxy settles: what was found above the target at first is below it by now, or the other way.
TEST(SizeSearch, DoesNotStayAtAnEndThatHasMoved)
{
    SizeSearch falling;
    double size = falling.next(1, 0.5);
    const std::vector<double> up = judged(
        falling, [](double s) { return 0.6 * (s - 3); }, size, 60);
    EXPECT_NEAR(up.back(), 3, 0.1 / 0.6);

    SizeSearch rising;
    size = rising.next(1, -0.5);
    const std::vector<double> down = judged(
        rising, [](double s) { return 0.6 * (s + 1); }, size, 60);
    EXPECT_NEAR(down.back(), -1, 0.1 / 0.6);
}

} // namespace
} // namespace slod::test
