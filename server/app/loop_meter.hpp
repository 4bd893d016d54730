#pragma once

#include <cstdint>

#include "app/pacer.hpp"
#include "sim/phase.hpp"

namespace slod {

/// Means over the frames of about a second.
struct LoopMeans {
    double frame_rate_hz = 0; ///< frames completed per second of wall time
    double work_ms = 0;       ///< of a frame: step and hand-over to the publisher, without the pacer's wait
    double real_time_factor = 0; ///< simulated seconds per second of wall time
    StepProfile profile;         ///< of a frame
};

/// Measures the loop second by second. Knows no clock: it is told when frames end.
class LoopMeter {
public:
    using Clock = Pacer::Clock;

    /// `frame_s`: simulated seconds (SI) of a frame.
    LoopMeter(double frame_s, Clock::time_point start) : frame_s_(frame_s), begin_(start) {}

    /// Takes in a frame that ended at `now`. True when it completes a second; the means are then of that
    /// second.
    bool add(Clock::time_point now, double work_ms, const StepProfile& profile);

    /// Begins a second anew at `now`, as after a pause; what was measured of the one under way is left out.
    void restart(Clock::time_point now);

    /// Of the last full second; of the frames so far while the first one lasts.
    const LoopMeans& means() const { return means_; }

private:
    double frame_s_;
    Clock::time_point begin_;
    std::uint64_t frames_ = 0;
    double work_ms_ = 0;
    StepProfile profile_;
    LoopMeans means_;
    bool had_second_ = false;
};

} // namespace slod
