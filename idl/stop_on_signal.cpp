#include "idl/stop_on_signal.hpp"

#include <system_error>

namespace slod {

StopOnSignal::Blocked::Blocked()
{
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    if (const int error = pthread_sigmask(SIG_BLOCK, &signals_, &before_); error != 0)
        throw std::system_error(error, std::generic_category(), "cannot block signals");
}

StopOnSignal::Blocked::~Blocked()
{
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

StopOnSignal::StopOnSignal()
    : waiter_([this](const std::stop_token& ended) {
          int signal = 0;
          sigwait(&blocked_.signals(), &signal);
          if (!ended.stop_requested())
              source_.request_stop();
      })
{}

/// The waiting thread is sent what it waits for.
StopOnSignal::~StopOnSignal()
{
    waiter_.request_stop();
    if (!source_.stop_requested())
        pthread_kill(waiter_.native_handle(), SIGTERM);
}

} // namespace slod
