#include "app/publish_slot.hpp"

#include <utility>

namespace slod {

namespace {

void copy_numbers(const Snapshot& from, Snapshot& to)
{
    to.frame = from.frame;
    to.time = from.time;
    to.counts = from.counts;
    to.conserved = from.conserved;
    to.profile = from.profile;
}

} // namespace

std::uint64_t FrameSlot::put(const Snapshot& snapshot, const LoopStats& loop, Due due)
{
    std::uint64_t lost = 0;
    {
        const std::scoped_lock guard(lock_);
        copy_numbers(snapshot, slot_.newest);
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

bool FrameSlot::take(OfferedFrame& frame, const std::stop_token& stop,
                     std::chrono::steady_clock::time_point deadline)
{
    frame.due = {};
    std::unique_lock guard(lock_);
    if (!arrived_.wait_until(guard, stop, deadline, [this] { return fresh_; }))
        return false;
    std::swap(frame, slot_);
    fresh_ = false;
    return true;
}

} // namespace slod
