#pragma once

#include <signal.h>
#include <stop_token>
#include <thread>

namespace slod::client {

/// Turns SIGINT and SIGTERM into a stop request. Make it before any other thread: it blocks both signals,
/// later threads inherit that, and one thread of its own waits for them.
class StopOnSignal {
public:
    StopOnSignal();
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    std::stop_token token() const { return source_.get_token(); }

private:
    sigset_t signals_{};
    std::stop_source source_;
    std::jthread waiter_;
};

} // namespace slod::client
