#include "common/stop_on_signal.hpp"

#include <pthread.h>

namespace slod::client {

StopOnSignal::StopOnSignal()
{
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    waiter_ = std::jthread([this] {
        int signal = 0;
        sigwait(&signals_, &signal);
        source_.request_stop();
    });
}

/// The waiting thread is sent what it waits for; a signal that comes now finds nobody to stop.
StopOnSignal::~StopOnSignal()
{
    if (!source_.stop_requested())
        pthread_kill(waiter_.native_handle(), SIGTERM);
}

} // namespace slod::client
