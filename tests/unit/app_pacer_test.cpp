#include <chrono>

#include <gtest/gtest.h>

#include "app/pacer.hpp"
#include "support/case_rows.hpp"

namespace slod {
namespace {

using namespace std::chrono_literals;
using Time = Pacer::Clock::time_point;

constexpr Time start{100s};

// Frames that take no time and wakings that are always late: the due times stay on the grid of 1/rate.
TEST(Pacer, WakingLateDoesNotAddUp)
{
    Pacer pacer(50, start);
    Time now = start;
    for (int frame = 1; frame <= 1000; ++frame) {
        const Time due = pacer.next(now);
        EXPECT_EQ(due, start + frame * 20ms) << "frame " << frame;
        now = due + 3ms;
    }
}

// One frame takes 70 ms of 20: the next is due at once, and all later ones a full period apart from there.
TEST(Pacer, N06_ALateFrameMovesTheScheduleAndIsNotCaughtUp)
{
    Pacer pacer(50, start);
    const Time late = start + 70ms;
    EXPECT_EQ(pacer.next(late), late);
    EXPECT_EQ(pacer.next(late + 1ms), late + 20ms);
    EXPECT_EQ(pacer.next(late + 21ms), late + 40ms);
    // Frames that take 25 ms of 20 for ever: each begins when the last one ends, and none is made up for.
    Time now = late + 40ms;
    int early = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        const Time due = pacer.next(now += 25ms);
        early += due < now ? 1 : 0;
        EXPECT_LE(due, now + 20ms);
    }
    test::expect_at_most("frames that are run to catch up", early, 0);
}

TEST(Pacer, AFrameOnTheDotIsNotLate)
{
    Pacer pacer(50, start);
    EXPECT_EQ(pacer.next(start + 20ms), start + 20ms);
    EXPECT_EQ(pacer.next(start + 20ms), start + 40ms);
}

// Without an end of the sleep at the request this would take an hour.
TEST(Pacer, SleepEndsWhenStopIsRequested)
{
    std::stop_source source;
    source.request_stop();
    const auto end = Pacer::Clock::now() + 1h;
    sleep_until(end, source.get_token());
    EXPECT_LT(Pacer::Clock::now(), end);
}

} // namespace
} // namespace slod
