#include "support/full_team.hpp"

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "core/parallel.hpp"

namespace slod::test {

std::size_t gather_team(std::size_t wanted)
{
    std::mutex mutex;
    std::set<std::thread::id> seen;
    for (int round = 0; round < 1000 && seen.size() < wanted; ++round) {
        for_each_task(64, [&](std::size_t) {
            std::this_thread::sleep_for(std::chrono::microseconds(200));
            const std::lock_guard lock(mutex);
            seen.insert(std::this_thread::get_id());
        });
    }
    return seen.size();
}

} // namespace slod::test
