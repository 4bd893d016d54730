#include "app/publisher.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include <spdlog/spdlog.h>

#include "app/publish_picture.hpp"
#include "app/publish_rate.hpp"
#include "app/publish_slot.hpp"
#include "app/publish_state.hpp"
#include "app/publish_stats.hpp"
#include "idl/dds.hpp"

namespace slod {

namespace {

using Clock = std::chrono::steady_clock;

/// Clients take a server for dead or stalled by missing heartbeats; two in a row may come late.
constexpr std::chrono::milliseconds heartbeat_period{250};

constexpr std::string_view background_region = "background";

constexpr std::array published_topics{wire::topic<wire::Clusters>().name, wire::topic<wire::Overview>().name,
                                      wire::topic<wire::FrameManifest>().name,
                                      wire::topic<wire::Stats>().name, wire::topic<wire::ServerState>().name};

wire::Profile profile_of(WireProfile profile)
{
    return profile == WireProfile::Lan ? wire::Profile::Lan : wire::Profile::Loopback;
}

double milliseconds(Clock::duration duration)
{
    return std::chrono::duration<double, std::milli>(duration).count();
}

/// The cluster states of one region and where they go.
struct RegionStream {
    RegionStream(const wire::Participant& participant, const wire::Uuid& session, std::string_view region,
                 std::uint16_t index)
        : encoder(session, region, index), writer(participant, wire::region_partition(region))
    {}

    ClustersEncoder encoder;
    wire::Writer<wire::Clusters> writer;
};

} // namespace

/// The members used by the loop's thread are marked; the others belong to the publisher's thread. It is the
/// last member: it ends before anything it uses.
struct Publisher::Impl {
    Impl(const WireSettings& settings, const Session& facts);

    Due due(Clock::time_point now) const; // loop

    void run(const std::stop_token& stop);
    void publish(const OfferedFrame& frame);
    void publish_clusters(const OfferedFrame& frame);
    void publish_state();
    template <class Message>
    void send(wire::Writer<Message>& writer, const Message& message);
    void warn_of_large_sample(std::uint64_t bytes);
    wire::PublisherCounts counts() const;

    const WireSettings settings;
    const wire::Uuid session = wire::new_uuid();
    wire::Participant participant;
    RegionStream background;
    wire::Writer<wire::Overview> overview_writer;
    wire::Writer<wire::FrameManifest> manifest_writer;
    wire::Writer<wire::Stats> stats_writer;
    wire::Writer<wire::ServerState> state_writer;

    RateLimit clusters_rate; // loop
    RateLimit overview_rate; // loop
    FrameSlot slot;          // both

    RateLimit stats_rate;
    OverviewEncoder overview_encoder;
    ManifestEncoder manifest_encoder;
    StatsEncoder stats_encoder;
    StateEncoder state_encoder;
    OfferedFrame frame;
    Clock::time_point newest_completed = Clock::now();
    std::uint64_t largest_sample = 0;
    std::uint64_t warned_of_sample = 0;

    std::atomic<std::uint64_t> frames_offered{0}, frames_published{0}, frames_skipped{0}; // both
    std::atomic<std::uint64_t> samples_refused{0}, bytes{0};                              // both
    std::atomic<double> encode_ms{0};                                                     // both

    std::jthread thread;
};

Publisher::Impl::Impl(const WireSettings& wanted, const Session& facts)
    : settings(wanted), participant(settings.domain, profile_of(settings.profile)),
      background(participant, session, background_region, 0), overview_writer(participant),
      manifest_writer(participant), stats_writer(participant), state_writer(participant),
      clusters_rate(settings.clusters_rate), overview_rate(settings.overview_rate),
      stats_rate(settings.stats_rate), overview_encoder(session), manifest_encoder(session),
      stats_encoder(session), state_encoder(session, facts, published_topics)
{
    spdlog::info("publishing domain={} session={} {}", settings.domain, wire::to_string(session),
                 wire::configuration_source(profile_of(settings.profile)));
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Due Publisher::Impl::due(Clock::time_point now) const
{
    return {.clusters = clusters_rate.due(now) && background.writer.matched(),
            .overview = overview_rate.due(now) && overview_writer.matched()};
}

void Publisher::Impl::run(const std::stop_token& stop)
{
    Clock::time_point next_heartbeat = Clock::now();
    while (!stop.stop_requested()) {
        if (slot.take(frame, stop, next_heartbeat))
            publish(frame);
        if (Clock::now() >= next_heartbeat) {
            publish_state();
            next_heartbeat = Clock::now() + heartbeat_period;
        }
    }
    if (!state_writer.dispose(state_encoder.encode(0, largest_sample)))
        ++samples_refused;
}

void Publisher::Impl::publish(const OfferedFrame& taken)
{
    newest_completed = taken.completed;
    state_encoder.set_frame({.frame = taken.newest.frame, .time = taken.newest.time},
                            taken.newest.counts.particles, taken.loop);
    const Clock::time_point begin = Clock::now();
    if (taken.due.clusters)
        publish_clusters(taken);
    if (taken.due.overview)
        send(overview_writer, overview_encoder.encode(taken.newest.clusters, taken.clusters_stamp,
                                                      settings.max_overview_nodes));
    if (taken.due.any()) {
        ++frames_published;
        encode_ms = milliseconds(Clock::now() - begin);
    }
    if (stats_rate.due(begin) && stats_writer.matched()) {
        stats_rate.mark(begin);
        send(stats_writer, stats_encoder.encode(taken.newest, taken.loop, counts()));
    }
}

void Publisher::Impl::publish_clusters(const OfferedFrame& taken)
{
    const wire::Clusters& message =
        background.encoder.encode(taken.newest.clusters, taken.clusters_stamp, settings.max_clusters);
    send(background.writer, message);
    warn_of_large_sample(wire::wire_bytes(message));
    manifest_encoder.begin();
    manifest_encoder.add(background.encoder.manifest_entry());
    send(manifest_writer, manifest_encoder.encode(taken.clusters_stamp));
}

void Publisher::Impl::publish_state()
{
    send(state_writer, state_encoder.encode(milliseconds(Clock::now() - newest_completed), largest_sample));
}

template <class Message>
void Publisher::Impl::send(wire::Writer<Message>& writer, const Message& message)
{
    if (!writer.write(message)) {
        ++samples_refused;
        return;
    }
    const std::uint64_t size = wire::wire_bytes(message);
    bytes += size;
    largest_sample = std::max(largest_sample, size);
}

void Publisher::Impl::warn_of_large_sample(std::uint64_t size)
{
    if (size <= 2 * warned_of_sample)
        return;
    if (const auto warning = wire::receive_buffer_warning(size)) {
        spdlog::warn("{}", *warning);
        warned_of_sample = size;
    }
}

wire::PublisherCounts Publisher::Impl::counts() const
{
    return {.offered_frames = frames_offered,
            .published_frames = frames_published,
            .skipped_frames = frames_skipped,
            .refused_samples = samples_refused,
            .published_bytes = bytes,
            .encode_ms = encode_ms};
}

Publisher::Publisher(const WireSettings& settings, const Session& session)
    : impl_(std::make_unique<Impl>(settings, session))
{}

Publisher::~Publisher() = default;

bool Publisher::clusters_wanted() const
{
    return impl_->due(Clock::now()).any();
}

void Publisher::offer(const Snapshot& snapshot, const LoopStats& loop)
{
    const Clock::time_point now = Clock::now();
    const bool has_clusters = snapshot.clusters.size() == snapshot.counts.clusters;
    const Due due = has_clusters ? impl_->due(now) : Due{};
    if (due.clusters)
        impl_->clusters_rate.mark(now);
    if (due.overview)
        impl_->overview_rate.mark(now);
    ++impl_->frames_offered;
    impl_->frames_skipped += impl_->slot.put(snapshot, loop, due);
}

Publisher::Counters Publisher::counters() const
{
    const wire::PublisherCounts counts = impl_->counts();
    return {.frames_offered = counts.offered_frames,
            .frames_published = counts.published_frames,
            .frames_skipped = counts.skipped_frames,
            .samples_refused = counts.refused_samples,
            .bytes = counts.published_bytes,
            .encode_ms = counts.encode_ms};
}

} // namespace slod
