#include "app/publish_topics.hpp"

#include <algorithm>
#include <array>

#include <spdlog/spdlog.h>

namespace slod {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view background_region = "background";

constexpr std::array written_topics{wire::topic<wire::Clusters>().name, wire::topic<wire::Overview>().name,
                                    wire::topic<wire::FrameManifest>().name, wire::topic<wire::Stats>().name,
                                    wire::topic<wire::ServerState>().name};

wire::Profile profile_of(WireProfile profile)
{
    return profile == WireProfile::Lan ? wire::Profile::Lan : wire::Profile::Loopback;
}

double milliseconds(Clock::duration duration)
{
    return std::chrono::duration<double, std::milli>(duration).count();
}

} // namespace

wire::PublisherCounts PublishCounters::message() const
{
    return {.offered_frames = frames_offered,
            .published_frames = frames_published,
            .skipped_frames = frames_skipped,
            .refused_samples = samples_refused,
            .published_bytes = bytes,
            .encode_ms = encode_ms};
}

PublishedTopics::RegionStream::RegionStream(const wire::Participant& participant, const wire::Uuid& session,
                                            std::string_view region, std::uint16_t index)
    : encoder(session, region, index), writer(participant, wire::region_partition(region))
{}

PublishedTopics::PublishedTopics(const WireSettings& settings, const Publisher::Session& facts,
                                 PublishCounters& counters)
    : settings_(settings), counters_(counters), participant_(settings.domain, profile_of(settings.profile)),
      background_(participant_, session_, background_region, 0), manifest_encoder_(session_),
      manifest_writer_(participant_), overview_encoder_(session_), overview_writer_(participant_),
      stats_rate_(settings.stats_rate), stats_encoder_(session_), stats_writer_(participant_),
      state_encoder_(session_, facts, written_topics), state_writer_(participant_)
{
    spdlog::info("publishing domain={} session={} {}", settings.domain, wire::to_string(session_),
                 wire::configuration_source(profile_of(settings.profile)));
}

void PublishedTopics::publish(const OfferedFrame& frame)
{
    const Clock::time_point begin = Clock::now();
    newest_completed_ = frame.completed;
    state_encoder_.set_frame({.frame = frame.newest.frame, .time = frame.newest.time},
                             frame.newest.counts.particles, frame.loop);
    if (frame.due.clusters)
        publish_clusters(frame);
    if (frame.due.overview)
        send(overview_writer_, overview_encoder_.encode(frame.newest.clusters, frame.clusters_stamp,
                                                        settings_.max_overview_nodes));
    if (frame.due.any()) {
        ++counters_.frames_published;
        counters_.encode_ms = milliseconds(Clock::now() - begin);
    }
    if (stats_rate_.due(begin) && stats_writer_.matched()) {
        stats_rate_.mark(begin);
        send(stats_writer_, stats_encoder_.encode(frame.newest, frame.loop, counters_.message()));
    }
}

void PublishedTopics::publish_clusters(const OfferedFrame& frame)
{
    const wire::Clusters& message =
        background_.encoder.encode(frame.newest.clusters, frame.clusters_stamp, settings_.max_clusters);
    send(background_.writer, message);
    warn_of_large_sample(wire::wire_bytes(message));
    manifest_encoder_.begin();
    manifest_encoder_.add(background_.encoder.manifest_entry());
    send(manifest_writer_, manifest_encoder_.encode(frame.clusters_stamp));
}

void PublishedTopics::publish_state()
{
    const double idle_ms = milliseconds(Clock::now() - newest_completed_);
    send(state_writer_, state_encoder_.encode(idle_ms, largest_sample_));
}

void PublishedTopics::take_leave()
{
    if (!state_writer_.dispose(state_encoder_.encode(0, largest_sample_)))
        ++counters_.samples_refused;
}

template <class Message>
void PublishedTopics::send(wire::Writer<Message>& writer, const Message& message)
{
    if (!writer.write(message)) {
        ++counters_.samples_refused;
        return;
    }
    const std::uint64_t bytes = wire::wire_bytes(message);
    counters_.bytes += bytes;
    largest_sample_ = std::max(largest_sample_, bytes);
}

/// Once, and again when samples have doubled.
void PublishedTopics::warn_of_large_sample(std::uint64_t bytes)
{
    if (bytes <= 2 * warned_of_sample_)
        return;
    if (const auto warning = wire::receive_buffer_warning(bytes)) {
        spdlog::warn("{}", *warning);
        warned_of_sample_ = bytes;
    }
}

} // namespace slod
