#include <chrono>

#include <gtest/gtest.h>

#include "app/loop_meter.hpp"

namespace slod {
namespace {

using namespace std::chrono_literals;
using Time = LoopMeter::Clock::time_point;

constexpr Time start{100s};

StepProfile forces(double milliseconds)
{
    StepProfile profile;
    profile[Phase::Forces] = milliseconds;
    return profile;
}

// Four frames a second of 0.5 simulated seconds each, with work of 1, 2, 3 and 4 ms. All numbers are exact.
TEST(LoopMeter, MeansAreThoseOfTheFullSecond)
{
    LoopMeter meter(0.5, start);
    for (int frame = 1; frame <= 3; ++frame)
        EXPECT_FALSE(meter.add(start + frame * 250ms, frame, forces(2.0 * frame)));
    EXPECT_TRUE(meter.add(start + 1000ms, 4, forces(8)));
    EXPECT_EQ(meter.means().frame_rate_hz, 4);
    EXPECT_EQ(meter.means().work_ms, 2.5);
    EXPECT_EQ(meter.means().real_time_factor, 2);
    EXPECT_EQ(meter.means().profile[Phase::Forces], 5);
}

// The frames of a second that is not over do not show yet, nor does the second before.
TEST(LoopMeter, SecondsDoNotMix)
{
    LoopMeter meter(1, start);
    EXPECT_TRUE(meter.add(start + 1s, 10, {}));
    EXPECT_FALSE(meter.add(start + 1500ms, 20, {}));
    EXPECT_EQ(meter.means().work_ms, 10);
    EXPECT_TRUE(meter.add(start + 2s, 40, {}));
    EXPECT_EQ(meter.means().work_ms, 30);
    EXPECT_EQ(meter.means().frame_rate_hz, 2);
}

// Four frames a second, but for a pause of an hour after the fifth.
TEST(LoopMeter, APauseIsPartOfNoSecond)
{
    LoopMeter meter(1, start);
    for (int frame = 1; frame <= 5; ++frame)
        meter.add(start + frame * 250ms, 10, forces(1));
    const Time resumed = start + 1h;
    meter.restart(resumed);
    EXPECT_EQ(meter.means().frame_rate_hz, 4) << "of the last full second";
    for (int frame = 1; frame <= 3; ++frame)
        EXPECT_FALSE(meter.add(resumed + frame * 250ms, 20, forces(3)));
    EXPECT_TRUE(meter.add(resumed + 1s, 20, forces(3)));
    EXPECT_EQ(meter.means().frame_rate_hz, 4);
    EXPECT_EQ(meter.means().work_ms, 20) << "the frame before the pause is of neither second";
    EXPECT_EQ(meter.means().profile[Phase::Forces], 3);
}

TEST(LoopMeter, TheFirstSecondShowsTheFramesSoFar)
{
    LoopMeter meter(1, start);
    EXPECT_FALSE(meter.add(start + 250ms, 10, {}));
    EXPECT_EQ(meter.means().frame_rate_hz, 4);
    EXPECT_FALSE(meter.add(start + 500ms, 20, {}));
    EXPECT_EQ(meter.means().work_ms, 15);
}

} // namespace
} // namespace slod
