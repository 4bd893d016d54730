#pragma once

#include <chrono>
#include <stop_token>

namespace slod {

/// Holds a frame rate. Frames are due at absolute times, so that waking late once does not add up; a frame
/// that ends after its time moves all later ones: the simulation falls behind wall time and never catches up.
class Pacer {
public:
    using Clock = std::chrono::steady_clock;

    /// The first frame begins at `start`. `rate_hz` > 0.
    Pacer(double rate_hz, Clock::time_point start);

    /// Takes another rate for the frames to come. `rate_hz` > 0.
    void set_rate(double rate_hz);

    /// When the next frame is due, the present one having ended at `now`; never before `now`.
    Clock::time_point next(Clock::time_point now);

private:
    Clock::duration period_{};
    Clock::time_point due_;
};

/// Sleeps until `time`, or until stop is requested.
void sleep_until(Pacer::Clock::time_point time, const std::stop_token& stop);

} // namespace slod
