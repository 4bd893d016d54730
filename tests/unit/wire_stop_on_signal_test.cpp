#include <csignal>
#include <future>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "idl/stop_on_signal.hpp"

namespace slod {
namespace {

class Signal : public testing::TestWithParam<int> {};

// The process signals itself; without the block this would end it, without the waiting thread it would hang.
TEST_P(Signal, BecomesAStopRequest)
{
    const StopOnSignal signals;
    EXPECT_FALSE(signals.token().stop_requested());
    std::promise<void> stopped;
    const std::stop_callback on_stop(signals.token(), [&] { stopped.set_value(); });
    kill(getpid(), GetParam());
    stopped.get_future().wait();
    EXPECT_TRUE(signals.token().stop_requested());
}

INSTANTIATE_TEST_SUITE_P(Both, Signal, testing::Values(SIGINT, SIGTERM));

// The kernel gives a process's signal to any thread that does not block it.
TEST(StopOnSignal, LaterThreadsBlockTheSignalsToo)
{
    const StopOnSignal signals;
    std::thread([] {
        sigset_t blocked;
        pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
        EXPECT_EQ(sigismember(&blocked, SIGINT), 1);
        EXPECT_EQ(sigismember(&blocked, SIGTERM), 1);
    }).join();
}

} // namespace
} // namespace slod
