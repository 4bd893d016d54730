#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>

#include "app/publish_fields.hpp"
#include "app/publisher.hpp"
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

/// Holds the newest frame. Has the program's one lock: the loop waits for the publisher no longer than it
/// takes to exchange two frames, and the publisher for the loop no longer than a copy.
class FrameSlot {
public:
    /// Replaces the frame in the slot. Clusters that are waiting there stay if `due` asks for none; if it
    /// does they are replaced. Returns how many frames' clusters were lost by that.
    std::uint64_t put(const Snapshot& snapshot, const LoopStats& loop, Due due);

    /// Exchanges `frame` for the one in the slot, waiting for it until `deadline` or a stop. False: none
    /// came.
    bool take(OfferedFrame& frame, const std::stop_token& stop,
              std::chrono::steady_clock::time_point deadline);

private:
    std::mutex lock_;
    std::condition_variable_any arrived_;
    bool fresh_ = false;
    OfferedFrame slot_;
};

} // namespace slod
