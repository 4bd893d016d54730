#include "app/publish_topics.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <string_view>
#include <vector>

#include <spdlog/spdlog.h>

namespace slod {

namespace {

using Clock = std::chrono::steady_clock;

/// What a region holds is told so often while it changes.
constexpr double region_counts_hz = 1;

constexpr std::array written_topics{
    wire::topic<wire::Clusters>().name,      wire::topic<wire::Overview>().name,
    wire::topic<wire::FrameManifest>().name, wire::topic<wire::Stats>().name,
    wire::topic<wire::ErrorEstimate>().name, wire::topic<wire::EffectStats>().name,
    wire::topic<wire::Alarm>().name,         wire::topic<wire::RoiState>().name,
    wire::topic<wire::ServerState>().name,   wire::topic<wire::CommandReply>().name};
constexpr std::array read_topics{wire::topic<wire::Command>().name, wire::topic<wire::View>().name};

std::vector<std::string_view> topics_of(const WireSettings& settings)
{
    std::vector<std::string_view> topics(written_topics.begin(), written_topics.end());
    if (settings.commands)
        topics.insert(topics.end(), read_topics.begin(), read_topics.end());
    return topics;
}

wire::Profile profile_of(WireProfile profile)
{
    return profile == WireProfile::Lan ? wire::Profile::Lan : wire::Profile::Loopback;
}

/// Processor time of the calling thread so far: what encoding costs, however many others want the core.
double thread_ms()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

double milliseconds(Clock::duration duration)
{
    return std::chrono::duration<double, std::milli>(duration).count();
}

} // namespace

PublishedTopics::PublishedTopics(const WireSettings& settings, const Publisher::Session& facts,
                                 PublishCounters& counters)
    : settings_(settings), outlet_(counters), participant_(settings.domain, profile_of(settings.profile)),
      regions_(participant_, session_, outlet_), region_counts_rate_(region_counts_hz),
      reply_writer_(participant_), manifest_encoder_(session_), manifest_writer_(participant_),
      overview_encoder_(session_), overview_writer_(participant_), stats_rate_(settings.stats_rate),
      stats_encoder_(session_), stats_writer_(participant_), errors_(participant_, session_, outlet_),
      effects_(participant_, session_, outlet_), alarms_(participant_, session_, outlet_),
      state_encoder_(session_, facts, topics_of(settings)), state_writer_(participant_)
{
    spdlog::info("publishing domain={} session={} {}", settings.domain, wire::to_string(session_),
                 wire::configuration_source(profile_of(settings.profile)));
}

void PublishedTopics::publish(const OfferedFrame& frame)
{
    const Clock::time_point begin = Clock::now();
    const double begin_ms = thread_ms();
    newest_completed_ = frame.completed;
    state_encoder_.set_frame({.frame = frame.newest.frame, .time = frame.newest.time},
                             frame.newest.counts.particles, frame.loop);
    if (frame.due.clusters)
        publish_clusters(frame);
    if (frame.due.overview)
        outlet_.send(overview_writer_, overview_encoder_.encode(frame.newest.clusters, frame.clusters_stamp,
                                                                settings_.max_overview_nodes));
    if (frame.due.any()) {
        ++outlet_.counters().frames_published;
        outlet_.counters().encode_ms = thread_ms() - begin_ms;
    }
    stats_encoder_.set_conserved(frame.newest.conserved, frame.newest.potential_energy);
    if (stats_rate_.due(begin) && stats_writer_.matched()) {
        stats_rate_.mark(begin);
        outlet_.send(stats_writer_,
                     stats_encoder_.encode(frame.newest, frame.loop, outlet_.counters().message()));
    }
    errors_.update(frame.loop.errors, {.frame = frame.newest.frame, .time = frame.newest.time});
    effects_.update(frame.loop.effects);
    if (region_counts_rate_.due(begin)) {
        region_counts_rate_.mark(begin);
        regions_.write_counts(frame.newest.regions);
    }
}

void PublishedTopics::publish_clusters(const OfferedFrame& frame)
{
    manifest_encoder_.begin();
    regions_.write_clusters(frame.newest.clusters, frame.clusters_stamp, settings_.max_clusters,
                            manifest_encoder_);
    warn_of_large_sample(regions_.largest_clusters());
    outlet_.send(manifest_writer_, manifest_encoder_.encode(frame.clusters_stamp));
}

void PublishedTopics::publish(const Answer& answer)
{
    wire::CommandReply reply{};
    wire::set(reply.client, answer.client);
    reply.request = answer.number;
    wire::set(reply.session, session_);
    reply.result = answer.result;
    wire::set(reply.field, answer.field);
    wire::set_sentence(reply.text, answer.text);
    reply.applied_frame = answer.applied_frame;
    reply.revision = answer.revision;
    outlet_.send(reply_writer_, reply);
    answered_[answer.client] = Clock::now();
}

void PublishedTopics::forget_silent_clients()
{
    const Clock::time_point stale = Clock::now() - wire::topic<wire::CommandReply>().delivery.lifespan;
    std::erase_if(answered_, [&](const auto& answered) {
        if (answered.second >= stale)
            return false;
        wire::CommandReply gone{};
        wire::set(gone.client, answered.first);
        outlet_.forget(reply_writer_, gone);
        return true;
    });
}

void PublishedTopics::publish_state()
{
    state_encoder_.set_regions(regions_.count());
    state_encoder_.set_alarms(alarms_.count());
    const double idle_ms = milliseconds(Clock::now() - newest_completed_);
    outlet_.send(state_writer_, state_encoder_.encode(idle_ms, outlet_.largest_sample()));
}

void PublishedTopics::take_leave()
{
    constexpr std::chrono::milliseconds patience{200}; // with clients that stand still
    outlet_.dispose(state_writer_, state_encoder_.encode(0, outlet_.largest_sample()));
    state_writer_.flush(patience);
    reply_writer_.flush(patience);
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
