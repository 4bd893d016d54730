#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string_view>

#include "app/publish_picture.hpp"
#include "app/publish_rate.hpp"
#include "app/publish_slot.hpp"
#include "app/publish_state.hpp"
#include "app/publish_stats.hpp"
#include "app/publisher.hpp"
#include "idl/dds.hpp"

namespace slod {

/// What the publisher counts. Any thread may read it; each number has one thread that writes it.
struct PublishCounters {
    std::atomic<std::uint64_t> frames_offered{0};
    std::atomic<std::uint64_t> frames_published{0};
    std::atomic<std::uint64_t> frames_skipped{0};
    std::atomic<std::uint64_t> samples_refused{0};
    std::atomic<std::uint64_t> bytes{0};
    std::atomic<double> encode_ms{0};

    wire::PublisherCounts message() const;
};

/// The server's end of the wire: a participant, and for every topic it writes an encoder and a writer.
/// Belongs to the publisher's thread, but for the two questions.
class PublishedTopics {
public:
    /// Throws wire::DdsError with a remedy when the domain cannot be joined.
    PublishedTopics(const WireSettings& settings, const Publisher::Session& facts, PublishCounters& counters);

    /// Whether anybody reads them. Any thread may ask.
    bool clusters_read() const { return background_.writer.matched(); }
    bool overview_read() const { return overview_writer_.matched(); }

    /// Writes what is due of a frame, and its statistics where they are read and their rate allows.
    void publish(const OfferedFrame& frame);

    /// Writes the sign of life.
    void publish_state();

    /// Tells the clients that the server goes.
    void take_leave();

private:
    /// The cluster states of one region, and where they go.
    struct RegionStream {
        RegionStream(const wire::Participant& participant, const wire::Uuid& session, std::string_view region,
                     std::uint16_t index);

        ClustersEncoder encoder;
        wire::Writer<wire::Clusters> writer;
    };

    void publish_clusters(const OfferedFrame& frame);
    template <class Message>
    void send(wire::Writer<Message>& writer, const Message& message);
    void warn_of_large_sample(std::uint64_t bytes);

    WireSettings settings_;
    PublishCounters& counters_;
    wire::Uuid session_ = wire::new_uuid();
    wire::Participant participant_;
    RegionStream background_;
    ManifestEncoder manifest_encoder_;
    wire::Writer<wire::FrameManifest> manifest_writer_;
    OverviewEncoder overview_encoder_;
    wire::Writer<wire::Overview> overview_writer_;
    RateLimit stats_rate_;
    StatsEncoder stats_encoder_;
    wire::Writer<wire::Stats> stats_writer_;
    StateEncoder state_encoder_;
    wire::Writer<wire::ServerState> state_writer_;

    std::chrono::steady_clock::time_point newest_completed_ = std::chrono::steady_clock::now();
    std::uint64_t largest_sample_ = 0;
    std::uint64_t warned_of_sample_ = 0;
};

} // namespace slod
