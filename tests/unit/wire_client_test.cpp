#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/commander.hpp"
#include "common/frame_assembler.hpp"
#include "common/server_watch.hpp"
#include "common/stream_meter.hpp"

namespace slod::client {
namespace {

using namespace std::chrono_literals;

const wire::Uuid first_session{1};
const wire::Uuid second_session{2};
const Clock::time_point start{1h};

/// A server's sign of life.
wire::ServerState state(const wire::Uuid& session, std::uint64_t frame, double idle_ms = 0)
{
    wire::ServerState message{};
    wire::set(message.session, session);
    message.frame = frame;
    message.idle_ms = idle_ms;
    message.frame_rate_hz = 30;
    message.started_ns = session[0];
    return message;
}

TEST(WireClientWatch, ThereIsNoServerUntilOneIsHeard)
{
    const ServerWatch watch;
    EXPECT_EQ(watch.status(start).contact, Contact::NoServer);
    EXPECT_EQ(watch.server(), nullptr);
}

TEST(WireClientWatch, AServerWhoseFramesGrowIsLive)
{
    ServerWatch watch;
    watch.on_state(state(first_session, 7), start);
    EXPECT_EQ(watch.status(start + 100ms), (Status{Contact::Live, ""}));
    EXPECT_EQ(watch.server()->frame, 7U);
}

TEST(WireClientWatch, AServerThatAnswersWithoutNewFramesIsStalled)
{
    ServerWatch watch;
    watch.on_state(state(first_session, 7, 1900), start);
    EXPECT_EQ(watch.status(start).contact, Contact::Live);
    watch.on_state(state(first_session, 7, 2100), start + 200ms);
    EXPECT_EQ(watch.status(start + 200ms).contact, Contact::Stalled);
}

TEST(WireClientWatch, AServerWhosePublisherHangsIsStalled)
{
    ServerWatch watch;
    watch.on_state(state(first_session, 7), start);
    EXPECT_EQ(watch.status(start + 2100ms).contact, Contact::Stalled);
}

// At one frame in two seconds, seven seconds without one are less than four frames.
TEST(WireClientWatch, ASlowSimulationIsNotStalled)
{
    ServerWatch watch;
    wire::ServerState slow = state(first_session, 7, 7000);
    slow.frame_rate_hz = 0.5;
    watch.on_state(slow, start);
    EXPECT_EQ(watch.status(start).contact, Contact::Live);
}

TEST(WireClientWatch, APausedServerIsLive)
{
    ServerWatch watch;
    wire::ServerState paused = state(first_session, 7, 60'000);
    paused.paused = true;
    watch.on_state(paused, start);
    EXPECT_EQ(watch.status(start).contact, Contact::Live);
    EXPECT_NE(watch.status(start).reason, "");
}

TEST(WireClientWatch, TheReasonTellsAKilledServerFromAStoppedOne)
{
    ServerWatch killed;
    killed.on_state(state(first_session, 7), start);
    killed.on_gone(first_session, false);
    ServerWatch stopped;
    stopped.on_state(state(first_session, 7), start);
    stopped.on_gone(first_session, true);
    stopped.on_gone(first_session, false); // its silence, afterwards
    EXPECT_EQ(killed.status(start + 2s).contact, Contact::NoServer);
    EXPECT_EQ(stopped.status(start + 2s).contact, Contact::NoServer);
    EXPECT_NE(killed.status(start + 2s).reason.find("silent"), std::string::npos);
    EXPECT_NE(stopped.status(start + 2s).reason.find("stopped"), std::string::npos);
}

TEST(WireClientWatch, ARestartedServerIsFollowed)
{
    ServerWatch watch;
    watch.on_state(state(first_session, 7), start);
    watch.on_gone(first_session, false);
    watch.on_state(state(second_session, 1), start + 2s);
    EXPECT_EQ(watch.status(start + 2s).contact, Contact::Live);
    EXPECT_EQ(watch.server()->session, second_session);
}

TEST(WireClientWatch, ASecondServerDoesNotTakeOver)
{
    ServerWatch watch;
    watch.on_state(state(first_session, 7), start);
    watch.on_state(state(second_session, 1), start);
    watch.on_state(state(first_session, 8), start);
    EXPECT_EQ(watch.server()->session, first_session);
    EXPECT_EQ(watch.server()->frame, 8U);
    EXPECT_EQ(watch.others(), 1U);
}

TEST(WireClientWatch, ASilentServerThatSpeaksAgainIsLive)
{
    ServerWatch watch;
    watch.on_state(state(first_session, 7), start);
    watch.on_gone(first_session, false);
    watch.on_state(state(first_session, 8), start + 3s);
    EXPECT_EQ(watch.status(start + 3s).contact, Contact::Live);
}

/// One node of one region, at the given frame.
struct RegionSample {
    RegionSample(const std::string& region, std::uint64_t frame) : mass{float(frame)}
    {
        wire::set(message.region, region);
        message.frame = frame;
        wire::lend(message.mass, mass);
    }

    std::vector<float> mass;
    wire::Clusters message{};
};

struct Manifest {
    Manifest(const std::vector<std::string>& names, std::uint64_t frame) : regions(names.size())
    {
        for (std::size_t i = 0; i < names.size(); ++i)
            wire::set(regions[i].region, names[i]);
        message.frame = frame;
        wire::lend(message.regions, regions);
    }

    std::vector<wire::RegionCount> regions;
    wire::FrameManifest message{};
};

TEST(WireClientFrames, AFrameIsCompleteWhenAllItsRegionsHaveArrived)
{
    FrameAssembler frames;
    frames.on_clusters(RegionSample("a", 5).message);
    frames.on_manifest(Manifest({"a", "b"}, 5).message);
    EXPECT_EQ(frames.newest(), nullptr);
    frames.on_clusters(RegionSample("b", 5).message);
    ASSERT_NE(frames.newest(), nullptr);
    EXPECT_EQ(frames.newest()->frame, 5U);
    EXPECT_EQ(frames.newest()->nodes(), 2U);
}

TEST(WireClientFrames, RegionsOfDifferentFramesAreNeverMixed)
{
    FrameAssembler frames;
    frames.on_clusters(RegionSample("a", 4).message);
    frames.on_clusters(RegionSample("b", 5).message);
    frames.on_manifest(Manifest({"a", "b"}, 5).message);
    EXPECT_EQ(frames.newest(), nullptr);
    frames.on_clusters(RegionSample("a", 6).message);
    EXPECT_EQ(frames.newest(), nullptr);
}

TEST(WireClientFrames, TheNewestCompleteFrameStaysWhileTheNextArrives)
{
    FrameAssembler frames;
    for (std::uint64_t frame = 1; frame <= 4; ++frame) {
        frames.on_clusters(RegionSample("a", frame).message);
        if (frame > 1) {
            EXPECT_EQ(frames.newest()->frame, frame - 1);
        }
        frames.on_manifest(Manifest({"a"}, frame).message);
        ASSERT_NE(frames.newest(), nullptr);
        EXPECT_EQ(frames.newest()->frame, frame);
        EXPECT_EQ(frames.newest()->regions.at(0).mass.at(0), float(frame));
        EXPECT_EQ(frames.complete_count(), frame);
    }
}

TEST(WireClientFrames, ARegionAloneCompletesTheFrameOfWhoReadsItAlone)
{
    FrameAssembler frames("b");
    frames.on_clusters(RegionSample("b", 5).message);
    frames.on_manifest(Manifest({"a", "b", "c"}, 5).message);
    ASSERT_NE(frames.newest(), nullptr);
    EXPECT_EQ(frames.newest()->regions.size(), 1U);
}

TEST(WireClientFrames, AnotherSessionBeginsWithNothing)
{
    FrameAssembler frames;
    frames.on_clusters(RegionSample("a", 5).message);
    frames.on_manifest(Manifest({"a"}, 5).message);
    frames.on_clusters(RegionSample("a", 6).message);
    frames.reset();
    EXPECT_EQ(frames.newest(), nullptr);
    frames.on_manifest(Manifest({"a"}, 6).message);
    EXPECT_EQ(frames.newest(), nullptr);
}

TEST(WireClientFrames, ARegionThatComesAndGoesIsNeverShownAsItWas)
{
    FrameAssembler frames;
    std::uint64_t frame = 0;
    const auto arrive = [&](const std::vector<std::string>& names) {
        ++frame;
        for (const std::string& name : names)
            frames.on_clusters(RegionSample(name, frame).message);
        frames.on_manifest(Manifest(names, frame).message);
        ASSERT_EQ(frames.complete_count(), frame);
        for (std::size_t i = 0; i < names.size(); ++i) {
            EXPECT_EQ(frames.newest()->regions[i].region, names[i]) << "frame " << frame;
            EXPECT_EQ(frames.newest()->regions[i].mass.at(0), float(frame)) << names[i];
        }
    };
    for (const auto& names : std::vector<std::vector<std::string>>{
             {"a", "b"}, {"b"}, {"a", "b"}, {"b", "a"}, {"c", "a"}, {"a", "b", "c"}})
        arrive(names);
}

TEST(WireClientMeter, NumbersCountByRegion)
{
    StreamMeter meter;
    for (std::uint64_t serial = 1; serial <= 3; ++serial) {
        meter.on_sample("a", serial, 100, 1ms, start);
        meter.on_sample("b", 100 + 2 * serial, 100, 1ms, start);
    }
    EXPECT_EQ(meter.report(start).received, 6U);
    EXPECT_EQ(meter.report(start).lost, 2U);
}

TEST(WireClientMeter, GapsInTheNumbersAreLosses)
{
    StreamMeter meter;
    for (const std::uint64_t serial : {7, 8, 10, 14})
        meter.on_sample("", serial, 100, 1ms, start);
    const StreamMeter::Report report = meter.report(start);
    EXPECT_EQ(report.received, 4U);
    EXPECT_EQ(report.lost, 4U);
    EXPECT_EQ(report.bytes, 400U);
}

TEST(WireClientMeter, RateAndLatencyAreThoseOfTheLastTwoSeconds)
{
    StreamMeter meter;
    meter.on_sample("", 1, 100, 500ms, start);
    const Clock::time_point now = start + 10s;
    for (std::uint64_t i = 0; i <= 10; ++i)
        meter.on_sample("", 2 + i, 100, i < 10 ? 2ms : 9ms, now - 1s + i * 100ms);
    const StreamMeter::Report report = meter.report(now);
    EXPECT_DOUBLE_EQ(report.rate_hz, 10); // ten periods in one second
    EXPECT_DOUBLE_EQ(report.bytes_per_s, 1000);
    EXPECT_DOUBLE_EQ(report.latency_p50_ms, 2);
    EXPECT_DOUBLE_EQ(report.latency_p99_ms, 9);
}

TEST(WireClientMeter, MoreSamplesThanItRemembersAreStillCounted)
{
    StreamMeter meter;
    for (std::uint64_t serial = 1; serial <= 1000; ++serial)
        meter.on_sample("", serial, 1, 1ms, start + serial * 1ms);
    const StreamMeter::Report report = meter.report(start + 1s);
    EXPECT_EQ(report.received, 1000U);
    EXPECT_DOUBLE_EQ(report.rate_hz, 1000);
}

TEST(WireClientCommander, ACommandWithMoreSettingsThanTheWireTakesIsAProblem)
{
    CommandRequest request{.kind = "set"};
    request.settings.assign(64, {"gravity.strength", "1"});
    EXPECT_EQ(problem(request), "");
    request.settings.emplace_back("gravity.strength", "1");
    EXPECT_NE(problem(request).find("65 settings"), std::string::npos) << problem(request);
}

} // namespace
} // namespace slod::client
