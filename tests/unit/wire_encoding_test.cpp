#include "wire_snapshots.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "app/publish_picture.hpp"
#include "app/publish_state.hpp"
#include "app/publish_stats.hpp"
#include "common/messages.hpp"

namespace slod {
namespace {

const wire::Uuid session{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};

/// Half an ulp of a float.
constexpr double float_rounding = std::numeric_limits<float>::epsilon() / 2;

/// The half width of the box that made-up positions lie in: no offset from its centre is longer on an axis.
constexpr double half_width = 100;

client::RegionClusters received(const wire::Clusters& message)
{
    client::RegionClusters clusters;
    client::assign(clusters, message);
    return clusters;
}

TEST(WireEncoding, AClientReadsTheClustersThatWereEncoded)
{
    const Snapshot snapshot = made_up_snapshot(17, 300);
    const ClusterStates& states = snapshot.clusters;
    ClustersEncoder encoder(session, "background");
    const auto clusters =
        received(encoder.encode(states, all_rows(states), {.frame = 17, .time = snapshot.time}, 1000));

    EXPECT_EQ(clusters.region, "background");
    EXPECT_EQ(clusters.frame, 17U);
    EXPECT_EQ(clusters.time, snapshot.time);
    EXPECT_EQ(clusters.region_clusters, 300U);
    EXPECT_EQ(clusters.clusters_per_node, 1U);
    ASSERT_EQ(clusters.mass.size(), 300U);
    for (std::size_t i = 0; i < states.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double position = clusters.origin[axis] + double(clusters.position[3 * i + axis]);
            // Rounded to float once relative to the box, and in double when added to an origin below 1100.
            const double tolerance =
                half_width * float_rounding + 1100 * std::numeric_limits<double>::epsilon();
            EXPECT_NEAR(position, states.position[i][Eigen::Index(axis)], tolerance);
            EXPECT_EQ(clusters.velocity[3 * i + axis], float(states.velocity[i][Eigen::Index(axis)]));
        }
        EXPECT_EQ(clusters.mass[i], float(states.mass[i]));
        EXPECT_EQ(clusters.particles[i], states.count[i]);
        for (std::size_t entry = 0; entry < 6; ++entry)
            EXPECT_EQ(clusters.covariance[6 * i + entry], states.covariance[i][entry]);
        EXPECT_EQ(clusters.cluster_id[i], std::uint64_t(i % 7) << 32 | i);
        EXPECT_EQ(clusters.formation[i], states.formation[i]);
    }
}

TEST(WireEncoding, TooManyClustersArePublishedAsSumsThatSaySo)
{
    const Snapshot snapshot = made_up_snapshot(1, 1000);
    ClustersEncoder encoder(session, "background");
    const auto clusters = received(encoder.encode(snapshot.clusters, all_rows(snapshot.clusters), {}, 64));
    EXPECT_EQ(clusters.mass.size(), 64U);
    EXPECT_EQ(clusters.region_clusters, 1000U);
    EXPECT_EQ(clusters.clusters_per_node, 16U);
    std::uint64_t particles = 0;
    for (const std::uint32_t count : clusters.particles)
        particles += count;
    EXPECT_EQ(particles, snapshot.counts.particles);
    const wire::RegionCount entry = encoder.manifest_entry();
    EXPECT_EQ(entry.published_nodes, 64U);
    EXPECT_EQ(entry.region_clusters, 1000U);
}

TEST(WireEncoding, AnOverviewNeverHasMoreNodesThanItMay)
{
    OverviewEncoder encoder(session);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{4096}, std::size_t{4097}}) {
        const wire::Overview& message = encoder.encode(made_up_clusters(count, 2), {}, 4096);
        EXPECT_EQ(message.mass._length, std::min(count, std::size_t{4096}));
        EXPECT_EQ(message.position._length, 3 * message.mass._length);
        EXPECT_EQ(message.scene_clusters, count);
    }
}

// One cluster: the radius is the root of the covariance's trace, 2 + 3 + 4.
TEST(WireEncoding, AnOverviewsRadiusIsTheRmsDistance)
{
    OverviewEncoder encoder(session);
    client::OverviewNodes overview;
    client::assign(overview, encoder.encode(made_up_clusters(1, 2), {}, 10));
    EXPECT_FLOAT_EQ(overview.radius.at(0), 3.0F);
}

TEST(WireEncoding, SamplesAreNumberedFromOne)
{
    const Snapshot snapshot = made_up_snapshot(1, 5);
    ClustersEncoder encoder(session, "background");
    EXPECT_EQ(encoder.encode(snapshot.clusters, all_rows(snapshot.clusters), {}, 10).serial, 1U);
    EXPECT_EQ(encoder.encode(snapshot.clusters, all_rows(snapshot.clusters), {}, 10).serial, 2U);
}

// Buffers grow to the largest frame and stay: a steady scene allocates nothing.
TEST(WireEncoding, ASmallerFrameReusesTheMemoryOfALargerOne)
{
    const ClusterStates large = made_up_clusters(500, 1);
    const ClusterStates small = made_up_clusters(400, 2);
    ClustersEncoder clusters(session, "background");
    OverviewEncoder overview(session);
    const wire::Clusters clusters_before = clusters.encode(large, all_rows(large), {}, 1000);
    const wire::Overview overview_before = overview.encode(large, {}, 100);
    const wire::Clusters& clusters_after = clusters.encode(small, all_rows(small), {}, 1000);
    const wire::Overview& overview_after = overview.encode(small, {}, 90);
    EXPECT_EQ(clusters_after.position._buffer, clusters_before.position._buffer);
    EXPECT_EQ(clusters_after.covariance._buffer, clusters_before.covariance._buffer);
    EXPECT_EQ(clusters_after.formation._buffer, clusters_before.formation._buffer);
    EXPECT_EQ(overview_after.position._buffer, overview_before.position._buffer);
    EXPECT_EQ(overview_after.radius._buffer, overview_before.radius._buffer);
}

TEST(WireEncoding, StatisticsHaveEveryPhaseAndEveryCount)
{
    const Snapshot snapshot = made_up_snapshot(17, 40);
    StatsEncoder encoder(session);
    client::ServerStats stats;
    wire::PublisherCounts published{};
    published.encode_ms = 1.5;
    const LoopStats loop{.frame_rate_hz = 59, .work_ms = 7, .real_time_factor = 0.9};
    client::assign(stats, encoder.encode(snapshot, loop, published));

    EXPECT_EQ(stats.frame, 17U);
    EXPECT_EQ(stats.frame_rate_hz, 59);
    EXPECT_EQ(stats.work_ms, 7);
    EXPECT_EQ(stats.real_time_factor, 0.9);
    EXPECT_EQ(stats.particles, snapshot.counts.particles);
    EXPECT_EQ(stats.clusters, 40U);
    EXPECT_EQ(stats.wire.encode_ms, 1.5);
    ASSERT_EQ(stats.phases_ms.size(), phase_count);
    EXPECT_EQ(stats.phases_ms[std::size_t(Phase::Forces)], std::pair(std::string("forces"), 4.5));

    // Particles and clusters have fields of their own; every other number of FrameCounts is listed by name,
    // of an effect of place one of three, or two where it has a boundary.
    constexpr std::size_t all_counts = sizeof(FrameCounts) / sizeof(std::uint64_t);
    std::size_t unlisted = 2;
    AllFields::for_each([&]<class F> { unlisted += HasBoundary<F> ? 1 : 2; });
    EXPECT_EQ(stats.counts.size(), all_counts - unlisted);
    std::uint64_t interactions = 0;
    for (const auto& [name, count] : stats.counts)
        if (name == "interactions")
            interactions = count;
    EXPECT_EQ(interactions, 12'345'678'901U);
}

TEST(WireEncoding, DriftIsSinceTheFirstMeasurement)
{
    StatsEncoder encoder(session);
    const LoopStats loop{};
    Snapshot snapshot = made_up_snapshot(1, 1);
    encoder.set_conserved(snapshot.conserved, snapshot.potential_energy);
    encoder.encode(snapshot, loop, {});
    snapshot.conserved.kinetic_energy += 0.25;
    encoder.set_conserved(snapshot.conserved, snapshot.potential_energy);
    const wire::Stats& later = encoder.encode(snapshot, loop, {});
    EXPECT_TRUE(later.conserved_measured);
    EXPECT_EQ(later.drift.kinetic_energy, 0.25);
    EXPECT_EQ(later.drift.mass, 0);
    EXPECT_TRUE(std::isnan(later.conserved.potential_energy));
}

// Whoever reads statistics now and then still learns what only some frames measure.
TEST(WireEncoding, TheLastMeasurementHoldsUntilTheNext)
{
    StatsEncoder encoder(session);
    Snapshot snapshot = made_up_snapshot(1, 1);
    encoder.set_conserved(snapshot.conserved, snapshot.potential_energy);
    const double mass = snapshot.conserved.mass;
    snapshot.conserved = {};
    const wire::Stats& later = encoder.encode(snapshot, {}, {});
    EXPECT_TRUE(later.conserved_measured);
    EXPECT_EQ(later.conserved.mass, mass);
}

TEST(WireEncoding, WhatWasNotMeasuredIsNotClaimed)
{
    StatsEncoder encoder(session);
    Snapshot snapshot = made_up_snapshot(1, 1);
    snapshot.conserved = {};
    EXPECT_FALSE(encoder.encode(snapshot, {}, {}).conserved_measured);
}

TEST(WireEncoding, AClientReadsWhatTheServerSaysOfItself)
{
    constexpr std::array<std::string_view, 2> topics{"clusters", "stats"};
    StateEncoder encoder(session, made_up_session(), topics);
    encoder.set_frame({.frame = 9, .time = 1.5}, 77,
                      {.frame_rate_hz = 30, .work_ms = 1, .real_time_factor = 2});
    encoder.set_paused(true);
    encoder.set_regions(3);
    client::ServerInfo info;
    client::assign(info, encoder.encode(12.5, 4096));
    EXPECT_EQ(info.session, session);
    EXPECT_EQ(info.heartbeat, 1U);
    EXPECT_EQ(info.frame, 9U);
    EXPECT_EQ(info.time, 1.5);
    EXPECT_EQ(info.idle_ms, 12.5);
    EXPECT_TRUE(info.paused);
    EXPECT_EQ(info.regions, 3U);
    EXPECT_EQ(info.particles, 77U);
    EXPECT_EQ(info.max_sample_bytes, 4096U);
    EXPECT_EQ(info.mass_kg, 1.989e40);
    EXPECT_EQ(info.scene_title, "made up");
    EXPECT_EQ(info.version, "0.0.1");
    EXPECT_EQ(info.threads, 2U);
    EXPECT_EQ(info.topics, (std::vector<std::string>{"clusters", "stats"}));
    EXPECT_EQ(encoder.encode(0, 0).heartbeat, 2U);
}

TEST(WireEncoding, ALongTextIsCutBetweenCharacters)
{
    char field[6];
    wire::set(field, "abcd\u00e9"); // the last character takes the fifth and the sixth byte
    EXPECT_STREQ(field, "abcd");
    wire::set(field, "abc\u00e9");
    EXPECT_STREQ(field, "abc\u00e9");
    wire::set(field, "");
    EXPECT_STREQ(field, "");
}

TEST(WireEncoding, ALongSentenceIsCutBetweenWords)
{
    char field[13];
    wire::set_sentence(field, "known are units"); // 15 letters
    EXPECT_STREQ(field, "known ...");
    wire::set_sentence(field, "use mass or time"); // what comes before the dots fills it
    EXPECT_STREQ(field, "use mass ...");
    wire::set_sentence(field, "known units.");
    EXPECT_STREQ(field, "known units.");
    wire::set_sentence(field, "xxxxxxxxxxxxxxx");
    EXPECT_STREQ(field, "xxxxxxxx ...");
}

TEST(WireEncoding, SessionsAreNotRepeated)
{
    EXPECT_NE(wire::new_uuid(), wire::new_uuid());
    EXPECT_EQ(wire::to_string(session), "01020304-0506-0708-090a-0b0c0d0e0f10");
}

} // namespace
} // namespace slod
