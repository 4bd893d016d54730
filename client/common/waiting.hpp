#pragma once

#include <chrono>
#include <stop_token>

#include "common/server_watch.hpp"

namespace slod::client {

inline Clock::duration from_seconds(double seconds)
{
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Waits until `arrived()`; false when `end` or a stop came first. `waiter` takes in what comes in its
/// wait(stop, timeout): a Connection, a Commander or what is made of them.
template <class Waiter, class Condition>
bool wait_until(Waiter& waiter, const std::stop_token& stop, Clock::time_point end, const Condition& arrived)
{
    while (!arrived()) {
        const Clock::time_point now = Clock::now();
        if (now >= end || stop.stop_requested())
            return false;
        waiter.wait(stop, end - now);
    }
    return true;
}

} // namespace slod::client
