#pragma once

#include <algorithm>
#include <chrono>

namespace slod::stress {

/// Says when something is due that happens at a rate. What could not be done in time is not caught up.
class Ticker {
public:
    using Clock = std::chrono::steady_clock;

    /// Never due.
    Ticker() = default;

    /// `rate_hz` 0: never.
    Ticker(double rate_hz, Clock::time_point start)
        : period_(rate_hz > 0 ? std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(1 / rate_hz))
                              : Clock::duration::max()),
          next_(rate_hz > 0 ? start : Clock::time_point::max())
    {}

    bool due(Clock::time_point now) const { return now >= next_; }

    /// It was done. Where it came late by more than half a period the next one does, too.
    void mark(Clock::time_point now) { next_ = std::max(next_, now - period_ / 2) + period_; }

private:
    Clock::duration period_ = Clock::duration::max();
    Clock::time_point next_ = Clock::time_point::max();
};

} // namespace slod::stress
