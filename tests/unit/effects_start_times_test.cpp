#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "effects/start_times.hpp"

// How many particles an emitter has started by a time, and when each one starts: one is the inverse of the
// other, and neither knows of frames.
namespace slod {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

EmitterSettings steady(double rate)
{
    return {.rate = rate};
}

EmitterSettings bursts(std::uint32_t burst, double period, double rate)
{
    return {.rate = rate, .burst = burst, .burst_period = period};
}

EmitterSettings scheduled(const NumberPairs& schedule, std::uint32_t burst = 0, double period = infinity)
{
    return {.schedule = schedule, .burst = burst, .burst_period = period};
}

/// What emitters can be told, in numbers that binary ones round.
std::vector<EmitterSettings> all_sorts()
{
    return {steady(0),
            steady(0.001),
            steady(333),
            steady(1e5 / 3),
            bursts(7, infinity, 0),
            bursts(1, 0.1, 0),
            bursts(13, 0.3, 41.7),
            bursts(1000, 1.0 / 3, 1e4),
            scheduled({{0, 100}}),
            scheduled({{0.1, 100}, {0.7, 0}, {1.3, 17.3}}),
            scheduled({{0, 10}, {0.55, 1e4}, {0.6, 0}}),
            scheduled({{0.2, 33.3}, {0.4, 0}, {0.5, 0}, {0.6, 77.7}}, 5, 0.2)};
}

// Started before t are exactly those k whose time is below t, to the last bit: at each one's own time, right
// before and right after it.
TEST(StartTimes, CountExactlyThoseThatStartedBefore)
{
    int sort = 0;
    for (const EmitterSettings& settings : all_sorts()) {
        SCOPED_TRACE("emitter " + std::to_string(sort++));
        const StartTimes starts(settings);
        EXPECT_EQ(starts.count_before(0), 0U);
        double before = 0;
        for (std::uint64_t k = 0; k < 3000; ++k) {
            const double time = starts.time_of(k);
            ASSERT_GE(time, before) << k;
            if (time == infinity)
                break;
            ASSERT_LE(starts.count_before(time), k);
            ASSERT_GT(starts.count_before(std::nextafter(time, infinity)), k);
            before = time;
        }
    }
}

// Numbers near 1e6 are 2^-33 apart, in which time a hundred start at this rate.
TEST(StartTimes, CountExactlyWhereManyStartBetweenTwoNumbers)
{
    const StartTimes starts(scheduled({{1e6, 1e12}}));
    double time = 1e6;
    for (int i = 0; i < 100; ++i) {
        time = std::nextafter(time + 1e-7 * i, infinity);
        const std::uint64_t count = starts.count_before(time);
        ASSERT_GT(count, 0U);
        ASSERT_LT(starts.time_of(count - 1), time);
        ASSERT_GE(starts.time_of(count), time);
    }
}

TEST(StartTimes, AreTheSameWhateverTheFrames)
{
    int sort = 0;
    for (const EmitterSettings& settings : all_sorts()) {
        SCOPED_TRACE("emitter " + std::to_string(sort++));
        const StartTimes starts(settings);
        for (const int frames_per_second : {30, 60, 120}) {
            const auto end_of = [&](int frame) { return double(frame) / frames_per_second; };
            std::uint64_t first = 0;
            for (int frame = 1; frame <= 2 * frames_per_second; ++frame) {
                const auto window = starts.window(end_of(frame - 1), end_of(frame));
                const std::uint64_t last = starts.count_before(end_of(frame));
                for (std::uint64_t k = first; k < last; k += 1 + (last - first) / 16) {
                    ASSERT_EQ(starts.time_of(k, window), starts.time_of(k)) << k;
                    ASSERT_GE(starts.time_of(k), end_of(frame - 1)) << k;
                    ASSERT_LT(starts.time_of(k), end_of(frame)) << k;
                }
                first = last;
            }
        }
    }
}

TEST(StartTimes, OfARateAreEvenlySpaced)
{
    const StartTimes starts(steady(333));
    for (std::uint64_t k = 0; k < 1000; ++k)
        ASSERT_EQ(starts.time_of(k), double(k) / 333);
}

TEST(StartTimes, OfABurstAreAllAtOnceAndOnceWithoutAPeriod)
{
    const StartTimes starts(bursts(50, infinity, 0));
    EXPECT_EQ(starts.count_before(1e-300), 50U);
    EXPECT_EQ(starts.count_before(1e30), 50U);
    EXPECT_EQ(starts.time_of(49), 0);
    EXPECT_EQ(starts.time_of(50), infinity);
}

TEST(StartTimes, OfBurstsComeBackEveryPeriodBesidesTheRate)
{
    const StartTimes starts(bursts(50, 0.5, 10)); // 50 and 5 in each period
    EXPECT_EQ(starts.count_before(0.5), 55U);
    EXPECT_EQ(starts.count_before(0.51), 106U);
    EXPECT_EQ(starts.count_before(10), 20 * 55U);
    for (std::uint64_t k = 0; k < 50; ++k) {
        EXPECT_EQ(starts.time_of(k), 0);
        EXPECT_EQ(starts.time_of(55 + k), 0.5);
    }
    for (std::uint64_t k = 0; k < 5; ++k)
        EXPECT_EQ(starts.time_of(50 + k), double(k) / 10);
    EXPECT_EQ(starts.time_of(105), 0.5); // the rate's own at 5 / 10, after the burst
}

// Piece by piece: 0 to 1, 10 a unit; nothing until 3; 4 a unit from there on.
TEST(StartTimes, FollowTheRatesOfASchedule)
{
    const StartTimes starts(scheduled({{0, 10}, {1, 0}, {3, 4}}));
    EXPECT_EQ(starts.count_before(1), 10U);
    EXPECT_EQ(starts.count_before(3), 10U);
    EXPECT_EQ(starts.count_before(4), 14U);
    EXPECT_EQ(starts.time_of(9), 0.9);
    EXPECT_EQ(starts.time_of(10), 3);
    EXPECT_EQ(starts.time_of(14), 4);
    EXPECT_EQ(StartTimes(scheduled({{2, 1}})).time_of(0), 2) << "nothing before the first time";
}

// A rate that changes before a particle is due carries over what has gathered: 0.75 until 0.5, and the rest
// of 0.25 at 2 a unit.
TEST(StartTimes, CarryAFractionOverToTheNextRate)
{
    EXPECT_EQ(StartTimes(scheduled({{0, 1.5}, {0.5, 2}})).time_of(1), 0.625);
}

// An absurd emitter comes to its end, neither to an overflow nor to an endless search.
TEST(StartTimes, EndWithTheNumbersOfAnEmittersParticles)
{
    for (const EmitterSettings& settings : {steady(1e12), bursts(1'000'000'000, 1e-12, 1e12),
                                            scheduled({{0, 1e12}, {1e12, 1e12}}), scheduled({{1e12, 1e12}})})
        EXPECT_EQ(StartTimes(settings).count_before(1e30), StartTimes::most);
}

} // namespace
} // namespace slod
