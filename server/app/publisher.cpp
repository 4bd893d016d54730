#include "app/publisher.hpp"

#include <chrono>
#include <thread>

#include "app/publish_rate.hpp"
#include "app/publish_slot.hpp"
#include "app/publish_topics.hpp"

namespace slod {

namespace {

using Clock = std::chrono::steady_clock;

/// Clients are promised two signs of life a second; at this period one may come late.
constexpr std::chrono::milliseconds heartbeat_period{250};

} // namespace

/// What the two threads share is the slot and the counters; the rates are the loop's, the rest is the
/// publisher's. Members end bottom-up: the thread before anything it uses.
struct Publisher::Impl {
    Impl(const WireSettings& settings, const Session& session)
        : clusters_rate(settings.clusters_rate), overview_rate(settings.overview_rate),
          topics(settings, session, counters), thread([this](const std::stop_token& stop) { run(stop); })
    {}

    /// What of a frame at `now` is due: the rate allows it, and somebody reads it.
    Due due(Clock::time_point now) const
    {
        return {.clusters = clusters_rate.due(now) && topics.clusters_read(),
                .overview = overview_rate.due(now) && topics.overview_read()};
    }

    void run(const std::stop_token& stop);

    PublishCounters counters;
    FrameSlot slot;
    RateLimit clusters_rate;
    RateLimit overview_rate;
    PublishedTopics topics;
    std::jthread thread;
};

void Publisher::Impl::run(const std::stop_token& stop)
{
    OfferedFrame frame;
    Clock::time_point next_heartbeat = Clock::now();
    while (!stop.stop_requested()) {
        if (slot.take(frame, stop, next_heartbeat))
            topics.publish(frame);
        if (Clock::now() >= next_heartbeat) {
            topics.publish_state();
            next_heartbeat = Clock::now() + heartbeat_period;
        }
    }
    topics.take_leave();
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
    ++impl_->counters.frames_offered;
    impl_->counters.frames_skipped += impl_->slot.put(snapshot, loop, due);
}

Publisher::Counters Publisher::counters() const
{
    const PublishCounters& counters = impl_->counters;
    return {.frames_offered = counters.frames_offered,
            .frames_published = counters.frames_published,
            .frames_skipped = counters.frames_skipped,
            .samples_refused = counters.samples_refused,
            .bytes = counters.bytes,
            .encode_ms = counters.encode_ms};
}

} // namespace slod
