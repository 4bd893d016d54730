#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "effects/emitter_settings.hpp"

namespace slod {

/// When an emitter's particles start: in bursts, and between them steadily, at a rate that is constant from
/// each time of the schedule to the next. Particle k starts at time_of(k), which never falls with k, and
/// count_before() is its exact inverse, to the last bit and whatever the frames: before t have started the k
/// with time_of(k) < t and no others. Times here are since the emitter's start.
class StartTimes {
public:
    explicit StartTimes(const EmitterSettings& settings);

    std::uint64_t count_before(double time) const;

    /// How many bursts begin before the ends of an interval; what is known of k that start in it.
    struct Window {
        std::uint64_t least_bursts, most_bursts;
    };
    Window window(double from, double to) const;

    /// Of a k that starts within the window, or of any; infinite: never.
    double time_of(std::uint64_t k, const Window& window) const;
    double time_of(std::uint64_t k) const
    {
        return time_of(k, {0, burst_ == 0 ? 0 : std::min(k, most) / burst_ + 1});
    }

    /// No emitter starts more.
    static constexpr std::uint64_t most = std::uint64_t{1} << 48;

private:
    /// From `time` on, when `count` would have started, at this rate.
    struct Piece {
        double time, count, rate;
    };

    std::uint64_t steady_before(double time) const;
    double steady_time(std::uint64_t k) const;
    std::uint64_t bursts_before(double time) const;
    double burst_time(std::uint64_t k) const;

    std::vector<Piece> pieces_; ///< in order of time
    std::uint64_t burst_;
    double period_;
};

} // namespace slod
