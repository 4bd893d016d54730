#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>

#include "app/publish_alarms.hpp"
#include "app/publish_effects.hpp"
#include "app/publish_errors.hpp"
#include "app/publish_outlet.hpp"
#include "app/publish_picture.hpp"
#include "app/publish_rate.hpp"
#include "app/publish_regions.hpp"
#include "app/publish_slot.hpp"
#include "app/publish_state.hpp"
#include "app/publish_stats.hpp"
#include "app/publisher.hpp"
#include "idl/dds.hpp"

namespace slod {

/// The server's end of the wire: a participant, and for every topic it writes an encoder and a writer.
/// Belongs to the publisher's thread, but for the questions.
class PublishedTopics {
public:
    /// Throws wire::DdsError with a remedy when the domain cannot be joined.
    PublishedTopics(const WireSettings& settings, const Publisher::Session& facts, PublishCounters& counters);

    /// Whether anybody reads them. Any thread may ask; for clusters the answer is as old as the last look.
    bool clusters_read() const { return clusters_read_; }
    bool overview_read() const { return overview_writer_.matched(); }
    bool errors_read() const { return errors_.read(); }
    bool effects_read() const { return effects_.read(); }

    /// Looks whether anybody reads clusters.
    void look_for_readers() { clusters_read_ = regions_.clusters_read(); }

    const wire::Participant& participant() const { return participant_; }
    const wire::Uuid& session() const { return session_; }

    /// Writes states of regions and answers to clients.
    void publish(const RegionRecord& region) { regions_.update(region); }
    void publish(const Answer& answer);
    void publish(const std::vector<Alarm>& alarms) { alarms_.update(alarms); }
    std::size_t region_count() const { return regions_.count(); }

    /// Writes what is due of a frame, and its statistics where they are read and their rate allows.
    void publish(const OfferedFrame& frame);

    /// Writes the sign of life.
    void publish_state();

    /// What the sign of life says from the next on.
    void set_paused(bool paused) { state_encoder_.set_paused(paused); }

    /// Forgets the instances of clients whose answers have all gone stale.
    void forget_silent_clients();

    /// Tells the clients that the server goes.
    void take_leave();

private:
    void publish_clusters(const OfferedFrame& frame);
    void warn_of_large_sample(std::uint64_t bytes);

    WireSettings settings_;
    Outlet outlet_;
    wire::Uuid session_ = wire::new_uuid();
    wire::Participant participant_;
    PublishedRegions regions_;
    RateLimit region_counts_rate_;
    wire::Writer<wire::CommandReply> reply_writer_;
    std::map<wire::Uuid, std::chrono::steady_clock::time_point> answered_; ///< clients, when last
    ManifestEncoder manifest_encoder_;
    wire::Writer<wire::FrameManifest> manifest_writer_;
    OverviewEncoder overview_encoder_;
    wire::Writer<wire::Overview> overview_writer_;
    RateLimit stats_rate_;
    StatsEncoder stats_encoder_;
    wire::Writer<wire::Stats> stats_writer_;
    PublishedErrors errors_;
    PublishedEffects effects_;
    PublishedAlarms alarms_;
    StateEncoder state_encoder_;
    wire::Writer<wire::ServerState> state_writer_;

    std::chrono::steady_clock::time_point newest_completed_ = std::chrono::steady_clock::now();
    std::atomic<bool> clusters_read_{false};
    std::uint64_t warned_of_sample_ = 0;
};

} // namespace slod
