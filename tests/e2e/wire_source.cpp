// A server without a simulation: publishes made-up frames, then falls silent or idle, as the test asks.
//   wire_source DOMAIN CLUSTERS FRAMES
// offers FRAMES frames (0: for ever) of CLUSTERS clusters, thirty a second, and then none, until SIGTERM.

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <stop_token>

#include "app/publisher.hpp"
#include "idl/stop_on_signal.hpp"
#include "unit/wire_snapshots.hpp"

namespace {

using namespace std::chrono_literals;

/// Nobody needs a source for longer than any test lasts.
constexpr auto lifetime = 2min;

void sleep_until(std::chrono::steady_clock::time_point moment, const std::stop_token& stop)
{
    std::mutex unused;
    std::unique_lock guard(unused);
    std::condition_variable_any never;
    never.wait_until(guard, stop, moment, [] { return false; });
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 4)
        return EXIT_FAILURE;
    const slod::StopOnSignal signals;
    const auto end = std::chrono::steady_clock::now() + lifetime;
    const auto clusters = std::strtoull(argv[2], nullptr, 10);
    const auto frames = std::strtoull(argv[3], nullptr, 10);

    slod::WireSettings settings;
    settings.domain = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
    slod::Publisher publisher(settings, slod::made_up_session());
    slod::Snapshot snapshot = slod::made_up_snapshot(0, clusters);
    const std::stop_token stop = signals.token();
    while (!stop.stop_requested() && std::chrono::steady_clock::now() < end) {
        if (frames == 0 || snapshot.frame < frames) {
            ++snapshot.frame;
            publisher.offer(snapshot, {.frame_rate_hz = 30, .work_ms = 5, .real_time_factor = 1});
        }
        sleep_until(std::chrono::steady_clock::now() + 33ms, stop);
    }
    return EXIT_SUCCESS;
}
