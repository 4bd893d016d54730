#pragma once

#include <signal.h>
#include <stop_token>
#include <thread>

namespace slod {

/// Turns SIGINT and SIGTERM into a stop request. Make it before any other thread: it blocks both signals,
/// later threads inherit that, and one thread of its own waits for them. No handler, no global.
class StopOnSignal {
public:
    StopOnSignal(); ///< throws std::system_error when signals cannot be blocked
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;

    /// Stop is requested once either signal has come.
    std::stop_token token() const { return source_.get_token(); }

private:
    /// Blocks the signals while it lives.
    class Blocked {
    public:
        Blocked();
        ~Blocked();
        Blocked(const Blocked&) = delete;
        Blocked& operator=(const Blocked&) = delete;

        const sigset_t& signals() const { return signals_; }

    private:
        sigset_t signals_{};
        sigset_t before_{};
    };

    Blocked blocked_;
    std::stop_source source_;
    std::jthread waiter_;
};

} // namespace slod
