#include "app/publish_slot.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace slod {

namespace {

/// Keeps what a frame that still waits has measured.
void copy_numbers(const Snapshot& from, Snapshot& to, bool waits)
{
    to.frame = from.frame;
    to.time = from.time;
    to.counts = from.counts;
    if (!waits || is_measured(from.conserved)) {
        to.conserved = from.conserved;
        to.potential_energy = from.potential_energy;
    }
    to.profile = from.profile;
    to.regions = from.regions;
    to.detail = from.detail;
}

} // namespace

std::uint64_t FrameSlot::put(const Snapshot& snapshot, const LoopStats& loop, Due due)
{
    std::uint64_t lost = 0;
    {
        std::unique_lock guard(lock_, std::try_to_lock);
        if (!guard)
            wait_for(guard);
        copy_numbers(snapshot, slot_.newest, fresh_);
        slot_.loop = loop;
        slot_.completed = std::chrono::steady_clock::now();
        if (due.any()) {
            lost = slot_.due.any() ? 1 : 0;
            slot_.newest.clusters = snapshot.clusters;
            slot_.clusters_stamp = {.frame = snapshot.frame, .time = snapshot.time};
            slot_.due.clusters |= due.clusters;
            slot_.due.overview |= due.overview;
        }
        fresh_ = true;
    }
    arrived_.notify_one();
    return lost;
}

void FrameSlot::wait_for(std::unique_lock<std::mutex>& guard)
{
    constexpr std::chrono::milliseconds long_wait{10};
    const auto begin = std::chrono::steady_clock::now();
    guard.lock();
    if (std::chrono::steady_clock::now() - begin >= long_wait)
        ++delayed_;
}

void FrameSlot::post(std::vector<Answer>&& answers, std::vector<RegionRecord>&& regions,
                     std::optional<bool> paused)
{
    {
        const std::scoped_lock guard(lock_);
        std::move(answers.begin(), answers.end(), std::back_inserter(mail_.answers));
        for (RegionRecord& record : regions)
            mail_.regions[record.settings.name] = std::move(record);
        if (paused)
            mail_.paused = paused;
    }
    arrived_.notify_one();
}

void FrameSlot::post(std::vector<Alarm>&& alarms)
{
    {
        const std::scoped_lock guard(lock_);
        mail_.alarms = std::move(alarms);
    }
    arrived_.notify_one();
}

std::size_t FrameSlot::waiting_answers()
{
    const std::scoped_lock guard(lock_);
    return mail_.answers.size();
}

Mail FrameSlot::take_mail()
{
    const std::scoped_lock guard(lock_);
    return std::exchange(mail_, {});
}

bool FrameSlot::take(OfferedFrame& frame, const std::stop_token& stop,
                     std::chrono::steady_clock::time_point deadline)
{
    frame.due = {};
    std::unique_lock guard(lock_);
    if (!arrived_.wait_until(guard, stop, deadline, [this] { return fresh_ || mail_.any(); }) || !fresh_)
        return false;
    std::swap(frame, slot_);
    fresh_ = false;
    return true;
}

} // namespace slod
