#include <chrono>
#include <signal.h>
#include <stop_token>

#include <gtest/gtest.h>

#include "app/publisher.hpp"
#include "common/connection.hpp"
#include "e2e/wire_support.hpp"
#include "support/case_rows.hpp"
#include "unit/wire_snapshots.hpp"

// The publisher without a simulation, over loopback, read by the clients' own library.
namespace slod {
namespace {

using namespace std::chrono_literals;
using client::Connection;
using client::Contact;
using test::eventually;

const LoopStats loop_stats{.frame_rate_hz = 30, .work_ms = 5, .real_time_factor = 1};

class WirePublish : public testing::Test {
protected:
    WirePublish()
    {
        settings.domain = domain.number();
        settings.clusters_rate = 1000; // these tests offer frames when they like
        settings.overview_rate = 1000;
        settings.stats_rate = 1000;
    }

    Connection connect(const client::Subscription& subscription) const
    {
        return Connection(domain.number(), wire::Profile::Loopback, subscription);
    }

    /// Offers made-up frames until the client says it is content.
    template <class Content>
    bool offer_until(Publisher& publisher, Connection& connection, const Content& content)
    {
        return eventually([&] {
            ++frame;
            publisher.offer(made_up_snapshot(frame, cluster_count, frame), loop_stats);
            connection.wait(std::stop_token(), 5ms);
            return content();
        });
    }

    static constexpr std::size_t cluster_count = 1000;

    test::FreeDomain domain;
    WireSettings settings;
    std::uint64_t frame = 0;
};

TEST_F(WirePublish, AClientReadsTheClustersThatWereOffered)
{
    Publisher publisher(settings, made_up_session());
    Connection connection = connect({.clusters = true});
    ASSERT_TRUE(offer_until(publisher, connection, [&] { return connection.frame() != nullptr; }));

    const client::ClusterFrame& received = *connection.frame();
    const Snapshot offered = made_up_snapshot(received.frame, cluster_count, received.frame);
    EXPECT_EQ(received.time, offered.time);
    ASSERT_EQ(received.regions.size(), 1U);
    const client::RegionClusters& region = received.regions[0];
    EXPECT_EQ(region.region, "background");
    EXPECT_EQ(region.time, offered.time);
    ASSERT_EQ(region.mass.size(), cluster_count);
    for (std::size_t i = 0; i < cluster_count; ++i) {
        EXPECT_EQ(region.mass[i], float(offered.clusters.mass[i]));
        EXPECT_EQ(region.particles[i], offered.clusters.count[i]);
        EXPECT_EQ(region.formation[i], offered.clusters.formation[i]);
        EXPECT_EQ(region.velocity[3 * i], float(offered.clusters.velocity[i].x()));
    }
}

TEST_F(WirePublish, AnOverviewHasNoMoreNodesThanTheSettingSays)
{
    settings.max_overview_nodes = 64;
    Publisher publisher(settings, made_up_session());
    Connection connection = connect({.overview = true});
    ASSERT_TRUE(offer_until(publisher, connection, [&] { return connection.overview() != nullptr; }));
    EXPECT_EQ(connection.overview()->mass.size(), 64U);
    EXPECT_EQ(connection.overview()->scene_clusters, cluster_count);
    EXPECT_EQ(connection.overview()->clusters_per_node, 16U);
}

TEST_F(WirePublish, StatisticsOfAFrameReachAClient)
{
    Publisher publisher(settings, made_up_session());
    Connection connection = connect({.stats = true});
    ASSERT_TRUE(offer_until(publisher, connection, [&] { return connection.stats() != nullptr; }));
    EXPECT_EQ(connection.stats()->clusters, cluster_count);
    EXPECT_EQ(connection.stats()->work_ms, loop_stats.work_ms);
    EXPECT_EQ(connection.stats()->phases_ms.size(), phase_count);
    EXPECT_EQ(connection.stats()->conserved.mass, 100);
}

// Without a reader the simulation is not asked for clusters, and what it offers is not encoded.
TEST_F(WirePublish, NothingIsExtractedThatNobodyReads)
{
    Publisher publisher(settings, made_up_session());
    Connection bystander = connect({.stats = true});
    ASSERT_TRUE(offer_until(publisher, bystander, [&] { return bystander.stats() != nullptr; }));
    EXPECT_FALSE(publisher.clusters_wanted());
    EXPECT_EQ(publisher.counters().frames_published, 0U);
    {
        Connection reader = connect({.clusters = true});
        EXPECT_TRUE(eventually([&] { return publisher.clusters_wanted(); }));
    }
    EXPECT_TRUE(eventually([&] { return !publisher.clusters_wanted(); }));
}

// The setting's rate is far below that of the offers: of all frames offered at once, one has its clusters
// published.
TEST_F(WirePublish, ClustersAreNotWantedMoreOftenThanTheRateSays)
{
    settings.clusters_rate = 0.01;
    Publisher publisher(settings, made_up_session());
    Connection reader = connect({.clusters = true});
    ASSERT_TRUE(eventually([&] { return publisher.clusters_wanted(); }));
    publisher.offer(made_up_snapshot(1, cluster_count), loop_stats);
    EXPECT_FALSE(publisher.clusters_wanted());
    for (std::uint64_t number = 2; number < 20; ++number)
        publisher.offer(made_up_snapshot(number, cluster_count), loop_stats);
    ASSERT_TRUE(eventually([&] { return publisher.counters().frames_published > 0; }));
    EXPECT_EQ(publisher.counters().frames_published, 1U);
    EXPECT_EQ(publisher.counters().frames_skipped, 0U);
    EXPECT_EQ(publisher.counters().frames_offered, 19U);
}

// A client that joins is told the state that was written last before it joined. Were it to wait for the next
// heartbeat, no join could ever meet the one the first client already has; with luck now and then a heartbeat
// comes between, so one meeting in a few joins proves it.
TEST_F(WirePublish, ALateJoinerGetsTheServersStateAtOnce)
{
    const Publisher publisher(settings, made_up_session());
    Connection early = connect({});
    ASSERT_TRUE(eventually([&] {
        early.wait(std::stop_token(), 100ms);
        return early.server() != nullptr;
    }));
    int meetings = 0;
    for (int join = 0; join < 20 && meetings == 0; ++join) {
        early.wait(std::stop_token(), 1s); // for a fresh heartbeat
        const std::uint64_t known = early.server()->heartbeat;
        Connection late = connect({});
        ASSERT_TRUE(eventually([&] {
            late.wait(std::stop_token(), 10ms);
            return late.server() != nullptr;
        }));
        meetings += late.server()->heartbeat == known ? 1 : 0;
    }
    EXPECT_GT(meetings, 0);
}

// The child reads clusters and is frozen in the middle. Frames are published or counted as skipped, DDS
// refuses nothing, another reader goes on; thawed, the child is back.
TEST_F(WirePublish, N21_AFrozenReaderDelaysNobody)
{
    Publisher publisher(settings, made_up_session());
    test::Child frozen(
        {SLODCTL, "watch", "--clusters", "--json", "--domain", domain.text(), "--timeout", "30"});
    ASSERT_TRUE(eventually([&] { return publisher.clusters_wanted(); }));
    Connection reader = connect({.clusters = true});
    ASSERT_TRUE(offer_until(publisher, reader, [&] { return reader.complete_frames() > 0; }));
    frozen.signal(SIGSTOP);

    const Publisher::Counters before = publisher.counters();
    const std::uint64_t frames_before = reader.complete_frames();
    constexpr std::uint64_t offers = 200;
    const Snapshot large = made_up_snapshot(1'000'000, 20'000);
    for (std::uint64_t offer = 0; offer < offers; ++offer) {
        Snapshot next = large;
        next.frame += offer;
        publisher.offer(next, loop_stats);
        reader.poll();
    }
    const auto handled = [&] {
        const Publisher::Counters now = publisher.counters();
        return now.frames_published + now.frames_skipped - before.frames_published - before.frames_skipped;
    };
    EXPECT_TRUE(offer_until(publisher, reader, [&] { return reader.complete_frames() > frames_before + 5; }));
    test::expect_at_least("frames published or skipped beside a frozen reader", double(handled()), 1);
    test::expect_at_most("samples refused", double(publisher.counters().samples_refused), 0);

    const std::size_t printed = frozen.output().size();
    frozen.signal(SIGCONT);
    const auto is_back = [&] { return frozen.output().find("\"live\"", printed) != std::string::npos; };
    EXPECT_TRUE(offer_until(publisher, reader, is_back));
    frozen.signal(SIGINT);
    EXPECT_EQ(frozen.wait(), 0) << frozen.errors();
}

TEST_F(WirePublish, TwoServersOnADomainAreToldApart)
{
    const Publisher first(settings, made_up_session());
    Connection connection = connect({});
    ASSERT_TRUE(eventually([&] {
        connection.wait(std::stop_token(), 100ms);
        return connection.server() != nullptr;
    }));
    const wire::Uuid followed = connection.server()->session;
    const Publisher second(settings, made_up_session());
    EXPECT_TRUE(eventually([&] {
        connection.wait(std::stop_token(), 100ms);
        return connection.other_servers() == 1;
    }));
    EXPECT_EQ(connection.server()->session, followed);
}

TEST_F(WirePublish, ADomainThatCannotBeJoinedIsExplained)
{
    setenv("CYCLONEDDS_URI",
           "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"nowhere0\"/>"
           "</Interfaces></General></Domain></CycloneDDS>",
           1);
    try {
        const Publisher publisher(settings, made_up_session());
        ADD_FAILURE() << "there is no interface nowhere0";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("CYCLONEDDS_URI"), std::string::npos) << error.what();
    }
    unsetenv("CYCLONEDDS_URI");
}

} // namespace
} // namespace slod
