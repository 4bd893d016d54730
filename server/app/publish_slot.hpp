#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/publish_fields.hpp"
#include "app/publisher.hpp"
#include "app/requests.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// What is to be published of a frame besides its numbers.
struct Due {
    bool clusters = false;
    bool overview = false;

    bool any() const { return clusters || overview; }
};

/// A frame on its way from the loop to the publisher's thread.
struct OfferedFrame {
    Snapshot newest; ///< its clusters are those of clusters_stamp
    LoopStats loop{};
    std::chrono::steady_clock::time_point completed;
    FrameStamp clusters_stamp;
    Due due; ///< of the clusters
};

/// What is on its way besides frames. Nothing of it is lost.
struct Mail {
    std::vector<Answer> answers;                 ///< in the order they were given
    std::map<std::string, RegionRecord> regions; ///< by name, the newest record of each
    std::optional<bool> paused;                  ///< when that has changed
    std::optional<std::vector<Alarm>> alarms;    ///< all there are, when that has changed

    bool any() const { return !answers.empty() || !regions.empty() || paused || alarms; }
};

/// Holds the newest frame and the mail. Has the program's one lock: the loop waits for the publisher no
/// longer than it takes to exchange two frames, and the publisher for the loop no longer than a copy.
class FrameSlot {
public:
    /// Replaces the frame in the slot. Clusters that are waiting there stay if `due` asks for none; if it
    /// does they are replaced. Returns how many frames' clusters were lost by that.
    std::uint64_t put(const Snapshot& snapshot, const LoopStats& loop, Due due);

    /// Hand-overs that waited for the publisher for 10 ms or more, which no exchange takes. For the thread
    /// that calls put().
    std::uint64_t delayed() const { return delayed_; }

    /// Adds to the mail.
    void post(std::vector<Answer>&& answers, std::vector<RegionRecord>&& regions, std::optional<bool> paused);

    void post(std::vector<Alarm>&& alarms);

    std::size_t waiting_answers();

    /// Exchanges `frame` for the one in the slot, waiting for it or for mail until `deadline` or a stop.
    /// False: no frame came.
    bool take(OfferedFrame& frame, const std::stop_token& stop,
              std::chrono::steady_clock::time_point deadline);

    /// All mail there is.
    Mail take_mail();

private:
    void wait_for(std::unique_lock<std::mutex>& guard);

    std::mutex lock_;
    std::condition_variable_any arrived_;
    bool fresh_ = false;
    OfferedFrame slot_;
    Mail mail_;
    std::uint64_t delayed_ = 0;
};

} // namespace slod
