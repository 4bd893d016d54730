#include "app/pacer.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace slod {

Pacer::Pacer(double rate_hz, Clock::time_point start) : due_(start)
{
    set_rate(rate_hz);
}

void Pacer::set_rate(double rate_hz)
{
    period_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate_hz));
}

Pacer::Clock::time_point Pacer::next(Clock::time_point now)
{
    due_ = std::max(due_ + period_, now);
    return due_;
}

void sleep_until(Pacer::Clock::time_point time, const std::stop_token& stop)
{
    std::mutex mutex;
    std::condition_variable_any stopped;
    std::unique_lock lock(mutex);
    stopped.wait_until(lock, stop, time, [] { return false; });
}

} // namespace slod
