#include "app/publisher.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "app/publish_rate.hpp"
#include "app/publish_slot.hpp"
#include "app/publish_topics.hpp"

namespace slod {

namespace {

using Clock = std::chrono::steady_clock;

/// Clients are promised two signs of life a second; at this period one may come late.
constexpr std::chrono::milliseconds heartbeat_period{250};

/// Answers that may wait for the publisher's thread.
constexpr std::size_t max_waiting_answers = 4096;

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

    /// Publishes a frame, if one came, and the mail: what is of a later frame than the clusters goes after
    /// them.
    void publish(const OfferedFrame* frame);

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
        const bool came = slot.take(frame, stop, next_heartbeat);
        publish(came ? &frame : nullptr);
        topics.look_for_readers();
        if (Clock::now() >= next_heartbeat) {
            topics.publish_state();
            topics.forget_silent_clients();
            next_heartbeat = Clock::now() + heartbeat_period;
        }
    }
    publish(nullptr);
    topics.take_leave();
}

void Publisher::Impl::publish(const OfferedFrame* frame)
{
    const Mail mail = slot.take_mail();
    const bool clusters = frame && frame->due.clusters;
    const std::size_t regions_before = topics.region_count();
    const auto publish_regions = [&](bool later) {
        for (const auto& [name, record] : mail.regions)
            if ((clusters && record.frame > frame->clusters_stamp.frame) == later)
                topics.publish(record);
    };
    publish_regions(false);
    if (frame)
        topics.publish(*frame);
    publish_regions(true);
    for (const Answer& answer : mail.answers)
        topics.publish(answer);
    if (mail.alarms)
        topics.publish(*mail.alarms);
    if (mail.paused)
        topics.set_paused(*mail.paused);
    if (mail.paused || mail.alarms || topics.region_count() != regions_before)
        topics.publish_state();
}

Publisher::Publisher(const WireSettings& settings, const Session& session)
    : impl_(std::make_unique<Impl>(settings, session))
{}

Publisher::~Publisher() = default;

bool Publisher::clusters_wanted() const
{
    return impl_->due(Clock::now()).any();
}

bool Publisher::errors_wanted() const
{
    return impl_->topics.errors_read();
}

bool Publisher::effects_wanted() const
{
    return impl_->topics.effects_read();
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
    impl_->counters.frames_delayed = impl_->slot.delayed();
}

void Publisher::tell(std::vector<Answer>&& answers, std::vector<RegionRecord>&& regions, bool paused)
{
    const std::optional<bool> news = paused != paused_ ? std::optional(paused) : std::nullopt;
    paused_ = paused;
    if (!answers.empty() || !regions.empty() || news)
        impl_->slot.post(std::move(answers), std::move(regions), news);
}

void Publisher::tell(std::vector<Alarm>&& alarms)
{
    impl_->slot.post(std::move(alarms));
}

std::size_t Publisher::answer_room() const
{
    return max_waiting_answers - std::min(impl_->slot.waiting_answers(), max_waiting_answers);
}

const wire::Participant& Publisher::participant() const
{
    return impl_->topics.participant();
}

const wire::Uuid& Publisher::session() const
{
    return impl_->topics.session();
}

Publisher::Counters Publisher::counters() const
{
    const PublishCounters& counters = impl_->counters;
    return {.frames_offered = counters.frames_offered,
            .frames_published = counters.frames_published,
            .frames_skipped = counters.frames_skipped,
            .frames_delayed = counters.frames_delayed,
            .samples_refused = counters.samples_refused,
            .bytes = counters.bytes,
            .encode_ms = counters.encode_ms};
}

} // namespace slod
