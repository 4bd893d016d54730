#include "app/loop_meter.hpp"

#include <chrono>

namespace slod {

bool LoopMeter::add(Clock::time_point now, double work_ms, const StepProfile& profile)
{
    ++frames_;
    work_ms_ += work_ms;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        profile_.milliseconds[phase] += profile.milliseconds[phase];

    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const bool full = seconds >= 1;
    if ((full || !had_second_) && seconds > 0) {
        const auto frames = double(frames_);
        means_.frame_rate_hz = frames / seconds;
        means_.real_time_factor = means_.frame_rate_hz * frame_s_;
        means_.work_ms = work_ms_ / frames;
        for (std::size_t phase = 0; phase < phase_count; ++phase)
            means_.profile.milliseconds[phase] = profile_.milliseconds[phase] / frames;
    }
    if (full) {
        had_second_ = true;
        restart(now);
    }
    return full;
}

void LoopMeter::restart(Clock::time_point now)
{
    begin_ = now;
    frames_ = 0;
    work_ms_ = 0;
    profile_ = {};
}

} // namespace slod
