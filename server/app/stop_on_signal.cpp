#include "app/stop_on_signal.hpp"

#include <cerrno>
#include <ctime>
#include <system_error>

#include "core/assert.hpp"

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
          // sigtimedwait cannot wait for a stop token too; a tenth of a second bounds the wait at exit.
          const timespec patience{.tv_sec = 0, .tv_nsec = 100'000'000};
          while (!ended.stop_requested()) {
              if (sigtimedwait(&blocked_.signals(), nullptr, &patience) > 0)
                  source_.request_stop();
              else
                  SLOD_ASSERT(errno == EAGAIN || errno == EINTR);
          }
      })
{}

} // namespace slod
