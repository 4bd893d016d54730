#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "stress/order.hpp"
#include "stress/process_use.hpp"
#include "stress/results.hpp"
#include "stress/server_use.hpp"
#include "stress/stream_tally.hpp"
#include "stress/ticker.hpp"

namespace slod::stress {
namespace {

TEST(StreamTally, AGapIsALossAndALowerNumberAnotherStream)
{
    StreamTally tally;
    for (const std::uint64_t serial : {10, 11, 14, 1, 2})
        tally.on_sample("a", serial);
    tally.on_sample("b", 100);
    EXPECT_EQ(tally.received(), 6U);
    EXPECT_EQ(tally.sent(), 8U) << "10 to 14, 1 to 2, and 100";
}

TEST(StreamTally, WhoseStreamEndedEarlyHasLostTheRest)
{
    StreamTally tally;
    for (std::uint64_t serial = 1; serial <= 50; ++serial)
        tally.on_sample("a", serial);
    const std::map<std::string, Span> latest{{"a", {.first = 1, .last = 100, .received = 100}}};
    EXPECT_EQ(delivered_share(tally.received(), tally.sent(), tally.open(), latest), 0.5);
    EXPECT_EQ(delivered_share(0, 0, {}, {}), 1);
}

/// A server at 10 frames a second that takes `busy` of one processor and publishes every second frame.
std::vector<ServerSample> samples(int count, double busy, double encode_ms)
{
    std::vector<ServerSample> all;
    for (int i = 0; i < count; ++i) {
        const auto frame = std::uint64_t(10 * i);
        all.push_back({.when_s = double(i),
                       .frame = frame,
                       .published_frames = frame / 2,
                       .published_bytes = frame / 2 * 1000000,
                       .delayed_frames = 3,
                       .refused_samples = 0,
                       .encode_ms = encode_ms,
                       .processor_s = 100 + busy * i,
                       .network_s = 0.01 * i,
                       .resident_mib = 50.0 + i});
    }
    return all;
}

TEST(ServerUse, IsWhatWasTakenBetweenTheFirstAndTheLastSample)
{
    const ServerUse use = use_of(samples(11, 0.2, 4));
    EXPECT_EQ(use.frames, 100U);
    EXPECT_DOUBLE_EQ(use.frame_rate_hz, 10);
    EXPECT_NEAR(*use.processor_ms, 20, 1e-9) << "0.2 s of 10 frames; 1e-9: rounding of sums near 100";
    EXPECT_NEAR(*use.network_ms, 1, 1e-9);
    EXPECT_DOUBLE_EQ(use.encode_ms, 2) << "4 ms for every second frame";
    EXPECT_DOUBLE_EQ(use.published_mb_s, 5);
    EXPECT_EQ(use.delayed_frames, 0U) << "what was before does not count";
    EXPECT_EQ(*use.middle_mib, 55);
    EXPECT_EQ(*memory_growth_mib(use), 5);
    EXPECT_EQ(use_of({}).frames, 0U);
}

TEST(ServerUse, GrowthIsOverTheTimeAtRestAndTheEncoding)
{
    const ServerUse rest = use_of(samples(11, 0.18, 0)), load = use_of(samples(11, 0.3, 4));
    EXPECT_NEAR(*processor_growth_percent(rest, load), 50, 1e-6) << "30 ms for 18 + 2";
    EXPECT_FALSE(processor_growth_percent(ServerUse(), load));
}

TEST(ServerUse, AStandstillLastsUntilTheNextFrameIsSeen)
{
    std::vector<ServerSample> all = samples(5, 0.1, 1);
    EXPECT_EQ(use_of(all).longest_standstill_s, 1);
    all[3].frame = all[2].frame;
    all[4].frame = all[2].frame;
    EXPECT_EQ(use_of(all).longest_standstill_s, 3) << "nothing is known of the second before";
}

TEST(ProcessUse, IsReadWhateverTheProgramIsCalled)
{
    const std::string stat = "7 (a) b (c) S 1 2 3 4 5 6 7 8 9 10 250 50 0 0 20";
    EXPECT_EQ(processor_s(stat, 100), 3);
    EXPECT_EQ(resident_mib("900 512 3 4", 4096), 2);
    EXPECT_TRUE(is_network_thread("recvUC"));
    EXPECT_FALSE(is_network_thread("slod-server"));
    EXPECT_FALSE(processor_s("", 100));
    EXPECT_FALSE(resident_mib("", 4096));
}

TEST(Ticker, KeepsItsRateAndDoesNotCatchUp)
{
    using std::chrono::milliseconds;
    const Ticker::Clock::time_point start{};
    Ticker ticker(100, start);
    int ticks = 0;
    for (int ms = 0; ms < 1000; ms += 3) // a look every 3 ms, which is no part of 10
        if (ticker.due(start + milliseconds(ms))) {
            ticker.mark(start + milliseconds(ms));
            ++ticks;
        }
    EXPECT_NEAR(ticks, 100, 1);
    const auto later = start + milliseconds(60000);
    EXPECT_TRUE(ticker.due(later));
    ticker.mark(later);
    EXPECT_FALSE(ticker.due(later));
    EXPECT_FALSE(Ticker(0, start).due(later));
}

TEST(StressOrder, TravelsAsJson)
{
    Order order;
    order.reader = Reader::Slow;
    order.index = 7;
    order.run = "r-";
    order.region = "core";
    order.rates.impostors = 2.5;
    const Order arrived = order_of(json_of(order));
    EXPECT_EQ(json_of(arrived), json_of(order));
    EXPECT_EQ(arrived.reader, Reader::Slow);
    EXPECT_EQ(arrived.rates.impostors, 2.5);
    EXPECT_FALSE(order_of(json_of(Order())).reader);
}

TEST(StressResults, TravelAsJson)
{
    SubscriberResult got{.reader = Reader::Stopped, .received = 3, .open = {{"a", {1, 4, 3}}}};
    got.latency.add(1.5);
    EXPECT_EQ(json_of(subscriber_result(json_of(got))), json_of(got));
    CommanderResult done{.kinds = {{"malformed", 2}},
                         .round_trip = got.latency,
                         .wrong_answers = {"x"},
                         .wrong_regions = {"y"}};
    done.valid.results["applied"] = 9;
    EXPECT_EQ(json_of(commander_result(json_of(done))), json_of(done));
}

} // namespace
} // namespace slod::stress
