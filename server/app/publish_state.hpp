#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/publish_fields.hpp"
#include "app/publisher.hpp"
#include "idl/messages.hpp"

namespace slod {

/// The server's sign of life.
class StateEncoder {
public:
    /// `topics` are those this server writes or reads.
    StateEncoder(const wire::Uuid& session, const Publisher::Session& facts,
                 std::span<const std::string_view> topics);

    void set_paused(bool paused) { message_.paused = paused; }
    void set_regions(std::size_t count) { message_.regions = std::uint32_t(count); }
    void set_alarms(std::size_t count) { message_.alarms = std::uint32_t(count); }

    /// Takes over the newest frame.
    void set_frame(const FrameStamp& stamp, std::uint64_t particles, const LoopStats& loop);

    /// `idle_ms` is the wall time since the newest frame was completed.
    const wire::ServerState& encode(double idle_ms, std::uint64_t max_sample_bytes);

private:
    std::vector<slod_v1_TopicName> topics_;
    wire::ServerState message_{};
};

} // namespace slod
