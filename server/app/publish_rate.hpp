#pragma once

#include <chrono>

namespace slod {

/// Lets events through at most so often in the mean, without beating against a loop of nearly the same
/// rate: an event may come half a period early, and the schedule does not move with it.
class RateLimit {
public:
    using Clock = std::chrono::steady_clock;

    explicit RateLimit(double rate_hz)
        : period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate_hz)))
    {}

    /// Whether an event may happen at `now`.
    bool due(Clock::time_point now) const { return now >= next_ - period_ / 2; }

    /// It happened. Where it came late by more than half a period the schedule starts anew from it: nothing
    /// is made up for.
    void mark(Clock::time_point now) { next_ = (now - next_ < period_ / 2 ? next_ : now) + period_; }

private:
    Clock::duration period_;
    Clock::time_point next_{};
};

} // namespace slod
