#include <cmath>
#include <cstdint>
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
        sizes.push_back(search.next(sizes.back(), excess(sizes.back()), sizes.size()));
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
    EXPECT_NEAR(SizeSearch().next(3, 10, 1), 3 - 0.7, 1e-15);
    EXPECT_NEAR(SizeSearch().next(3, -10, 1), 3 + 0.7, 1e-15);
}

TEST(SizeSearch, GoesBetweenTwoEndsByTheirErrorsAndKeepsAwayFromBoth)
{
    SizeSearch search;
    search.next(1, -0.3, 1);
    EXPECT_NEAR(search.next(2, 0.2, 2), 1.6, 1e-12);
    EXPECT_NEAR(search.next(1.6, 9, 3), 1.15, 1e-12); // a quarter of the way, and not a thirtieth
}

TEST(SizeSearch, KeepsBelowAJumpAndTriesItEverLessOften)
{
    SizeSearch search;
    double size = 0;
    std::vector<int> above; // frames in which it was
    for (int frame = 0; frame < 60'000; ++frame) {
        if (size >= 0.537)
            above.push_back(frame);
        EXPECT_TRUE(frame < 100 || size > 0.537 - 0.02) << size;
        size = search.next(size, jump(0.537)(size), std::uint64_t(frame));
    }
    ASSERT_GE(above.size(), 4u);
    const std::size_t last = above.size() - 1;
    EXPECT_LE(above.size(), 20u);
    EXPECT_GT(above[last] - above[last - 1], 8000);
    EXPECT_GE(above[last - 1] - above[last - 2], above[last - 2] - above[last - 3]);
    EXPECT_TRUE(search.kept_below_jump());
}

// As where the frame rate goes first and holds the size above the jump.
TEST(SizeSearch, JudgingASizeAgainIsNoFurtherTrialAndNoFurtherTurn)
{
    SizeSearch search;
    search.next(0, -0.4, 1);
    for (std::uint64_t frame = 2; frame < 400; ++frame)
        EXPECT_EQ(search.next(0.01, 0.6, frame), 0);
    EXPECT_EQ(search.next(0, -0.4, 500), 0);
    EXPECT_EQ(search.next(0, -0.4, 600), 0.01); // 512 frames after the first

    SizeSearch near;
    near.held();
    for (std::uint64_t frame = 1; frame < 9; ++frame)
        EXPECT_NEAR(near.next(1, -0.5, frame), 1.05, 1e-12);
}

// The error at the lower end stays as it is: nothing but a trial of the upper one shows it.
TEST(SizeSearch, FindsThatAJumpHasGone)
{
    SizeSearch search;
    double size = 0;
    std::uint64_t frame = 0;
    for (; frame < 5'000; ++frame)
        size = search.next(size, jump(0.537)(size), frame);
    EXPECT_LT(size, 0.537);
    for (; frame < 14'000; ++frame)
        size = search.next(size, jump(3)(size), frame);
    EXPECT_GT(size, 2.9);
    EXPECT_LT(size, 3);
}

TEST(SizeSearch, TriesTheUpperEndAtOnceWhereTheErrorBelowItFalls)
{
    SizeSearch search;
    search.next(0, -0.2, 1);
    search.next(0.01, 0.6, 2);
    EXPECT_EQ(search.next(0, -0.3, 50), 0) << "by chance";
    EXPECT_EQ(search.next(0, -0.4, 60), 0.01);
    EXPECT_EQ(search.next(0.01, 0.6, 61), 0);
    EXPECT_EQ(search.next(0, -0.4, 70), 0) << "that has been tried";
}

TEST(SizeSearch, AJumpFoundLowerDownInheritsNoWait)
{
    SizeSearch search;
    double size = 0;
    for (std::uint64_t frame = 0; frame < 20'000; ++frame)
        size = search.next(size, jump(0.537)(size), frame);
    int trials = 0; // of a jump that has moved, once it is found
    for (std::uint64_t frame = 20'000; frame < 22'000; ++frame) {
        trials += frame > 20'100 && size >= 0.3;
        size = search.next(size, jump(0.3)(size), frame);
    }
    EXPECT_EQ(trials, 2);
}

TEST(SizeSearch, TriesAnotherJumpAtOnce)
{
    SizeSearch search;
    search.next(0, -0.4, 1);
    search.next(0.01, 0.6, 2); // to be tried again in frame 514
    EXPECT_NEAR(search.next(0.01, -0.4, 100), 0.06, 1e-12);
    search.next(0.06, 0.6, 101);
    EXPECT_NEAR(search.next(0.045, -0.4, 102), 0.06, 1e-12);
}

TEST(SizeSearch, RemembersAJumpWhereTheErrorIsHeldBelowIt)
{
    SizeSearch search;
    search.next(1, -0.2, 1);
    search.next(1.01, 0.5, 2);
    search.held();
    EXPECT_EQ(search.next(1, -0.2, 3), 1);
    EXPECT_TRUE(search.kept_below_jump());
}

// What is learned of sizes is where they are to each other: a size of 1 is no special one.
TEST(SizeSearch, TurnsAreTheSameAtEverySize)
{
    const std::vector<double> excesses{-0.12, 0.5, 0.4, 0.3, -0.1, -0.2, 0.2, -0.3, -0.3, 0.6, 0.6, -0.1};
    const auto turns = [&](double from) {
        SizeSearch search;
        std::vector<double> made;
        double size = from;
        for (std::size_t i = 0; i < excesses.size(); ++i) {
            const double next = search.next(size, excesses[i], i);
            made.push_back(next - size);
            size = i % 3 == 0 ? size : next; // now and then it cannot follow
        }
        return made;
    };
    for (const double from : {-4.0, 0.1, 3.0})
        for (std::size_t i = 0; i < excesses.size(); ++i)
            EXPECT_NEAR(turns(from)[i], turns(0)[i], 1e-12) << "turn " << i << " from " << from;
}

TEST(SizeSearch, LooksNearByWhereItWasHeldAndWhereAnEndIsContradicted)
{
    SizeSearch held;
    held.held();
    EXPECT_NEAR(held.next(2, 0.5, 1), 2 - 0.05, 1e-15);
    EXPECT_NEAR(held.next(1.95, 0.5, 2), 1.95 - 0.1, 1e-15);

    SizeSearch contradicted;
    contradicted.next(2, -0.5, 1);
    EXPECT_EQ(contradicted.next(2.015, 0.5, 2), 2);
    EXPECT_NEAR(contradicted.next(2, 0.5, 3), 2 - 0.05, 1e-15);
}

// As while a galaxy settles: what was found above the target at first is below it by now, or the other way.
TEST(SizeSearch, DoesNotStayAtAnEndThatHasMoved)
{
    SizeSearch falling;
    double size = falling.next(1, 0.5, 1);
    const std::vector<double> up = judged(
        falling, [](double s) { return 0.6 * (s - 3); }, size, 60);
    EXPECT_NEAR(up.back(), 3, 0.1 / 0.6);

    SizeSearch rising;
    size = rising.next(1, -0.5, 1);
    const std::vector<double> down = judged(
        rising, [](double s) { return 0.6 * (s + 1); }, size, 60);
    EXPECT_NEAR(down.back(), -1, 0.1 / 0.6);
}

} // namespace
} // namespace slod::test
