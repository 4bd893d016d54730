#include "wire_snapshots.hpp"

#include <chrono>
#include <stop_token>

#include <gtest/gtest.h>

#include "app/publish_rate.hpp"
#include "app/publish_slot.hpp"

namespace slod {
namespace {

using namespace std::chrono_literals;

const LoopStats no_stats{};
constexpr Due nothing{};
constexpr Due clusters{.clusters = true, .overview = false};
constexpr Due overview{.clusters = false, .overview = true};

bool take(FrameSlot& slot, OfferedFrame& frame)
{
    return slot.take(frame, std::stop_token(), std::chrono::steady_clock::now());
}

TEST(WireSlot, OnlyTheNewestFrameIsTaken)
{
    FrameSlot slot;
    EXPECT_EQ(slot.put(made_up_snapshot(1, 3), no_stats, clusters), 0U);
    EXPECT_EQ(slot.put(made_up_snapshot(2, 4), no_stats, clusters), 1U);
    OfferedFrame frame;
    ASSERT_TRUE(take(slot, frame));
    EXPECT_EQ(frame.newest.frame, 2U);
    EXPECT_EQ(frame.newest.clusters.size(), 4U);
    EXPECT_FALSE(take(slot, frame));
}

// The numbers of a frame come often, its clusters rarely: they must not push each other out.
TEST(WireSlot, WaitingClustersOutliveFramesWithoutAny)
{
    FrameSlot slot;
    slot.put(made_up_snapshot(1, 3), no_stats, clusters);
    EXPECT_EQ(slot.put(made_up_snapshot(2, 0), no_stats, nothing), 0U);
    OfferedFrame frame;
    ASSERT_TRUE(take(slot, frame));
    EXPECT_EQ(frame.newest.frame, 2U);
    EXPECT_EQ(frame.clusters_stamp.frame, 1U);
    EXPECT_TRUE(frame.due.clusters);
    EXPECT_EQ(frame.newest.clusters.size(), 3U);
}

TEST(WireSlot, TheDetailOfAFrameComesWithItsNumbers)
{
    FrameSlot slot;
    Snapshot snapshot = made_up_snapshot(1, 0);
    snapshot.detail = {.cluster_size = 0.5, .opening = 2};
    slot.put(snapshot, no_stats, nothing);
    OfferedFrame frame;
    ASSERT_TRUE(take(slot, frame));
    EXPECT_EQ(frame.newest.detail, snapshot.detail);
}

TEST(WireSlot, WhatWasDueOfAReplacedFrameIsDueOfTheNewer)
{
    FrameSlot slot;
    slot.put(made_up_snapshot(1, 3), no_stats, overview);
    slot.put(made_up_snapshot(2, 3), no_stats, clusters);
    OfferedFrame frame;
    ASSERT_TRUE(take(slot, frame));
    EXPECT_TRUE(frame.due.clusters);
    EXPECT_TRUE(frame.due.overview);
}

TEST(WireSlot, WhatWasTakenIsNotDueAgain)
{
    FrameSlot slot;
    OfferedFrame frame;
    for (std::uint64_t number = 1; number <= 3; ++number) {
        slot.put(made_up_snapshot(number, 3), no_stats, clusters);
        ASSERT_TRUE(take(slot, frame));
    }
    slot.put(made_up_snapshot(4, 0), no_stats, nothing);
    ASSERT_TRUE(take(slot, frame));
    EXPECT_EQ(frame.newest.frame, 4U);
    EXPECT_FALSE(frame.due.any());
}

/// Events let through in `seconds` seconds when one is tried every `period`.
int let_through(RateLimit limit, RateLimit::Clock::duration period, int seconds)
{
    int count = 0;
    RateLimit::Clock::time_point now{1h};
    for (const auto end = now + std::chrono::seconds(seconds); now < end; now += period)
        if (limit.due(now)) {
            limit.mark(now);
            ++count;
        }
    return count;
}

TEST(WireRate, IsNotExceededInTheMean)
{
    // One event at either end of the interval may be counted besides the 10 s x 30 Hz.
    EXPECT_NEAR(let_through(RateLimit(30), 1ms, 10), 300, 1);
    EXPECT_NEAR(let_through(RateLimit(30), 7ms, 10), 300, 1);
}

// A loop at 30 Hz, a hair fast: every frame is let through but the one in hundreds by which it is fast.
TEST(WireRate, DoesNotThinALoopOfTheSameRate)
{
    const int frames = 10 * 30;
    EXPECT_GE(let_through(RateLimit(30), 33'300us, 10), frames - 1);
}

TEST(WireRate, MakesNothingUpAfterAPause)
{
    RateLimit limit(10);
    const RateLimit::Clock::time_point start{1h};
    limit.mark(start);
    const auto after_pause = start + 10s;
    limit.mark(after_pause);
    EXPECT_FALSE(limit.due(after_pause + 1ms));
}

} // namespace
} // namespace slod
