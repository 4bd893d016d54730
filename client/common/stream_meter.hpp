#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace slod::client {

/// Measures the samples of one topic as they arrive: rate, latency, loss, bytes. Memory is fixed but for the
/// names of the topic's streams.
class StreamMeter {
public:
    using Clock = std::chrono::steady_clock;

    struct Report {
        std::uint64_t received = 0;
        std::uint64_t lost = 0;    ///< sent since the first one received, but never received
        std::uint64_t bytes = 0;   ///< received
        double rate_hz = 0;        ///< over the last two seconds
        double bytes_per_s = 0;    ///< over the last two seconds
        double longest_gap_ms = 0; ///< between samples of the last two seconds
        double latency_p50_ms = 0; ///< of the last two seconds' samples, from the write to the read
        double latency_p99_ms = 0;
    };

    /// A sample was read, `latency` after it was written: number `serial` of its stream (0: they have
    /// none), which is the region in topics that have one and else empty.
    void on_sample(std::string_view stream, std::uint64_t serial, std::size_t bytes,
                   std::chrono::nanoseconds latency, Clock::time_point now);

    Report report(Clock::time_point now) const;

    /// Forgets everything: another session begins.
    void reset() { *this = {}; }

private:
    struct Arrival {
        Clock::time_point when;
        std::size_t bytes = 0;
        double latency_ms = 0;
    };

    static constexpr std::size_t remembered = 256;

    std::array<Arrival, remembered> arrivals_{}; ///< a ring; the newest is at (received_ - 1) % remembered
    std::uint64_t received_ = 0;
    std::uint64_t lost_ = 0;
    std::uint64_t bytes_ = 0;
    std::map<std::string, std::uint64_t, std::less<>> last_serial_; ///< by stream
};

} // namespace slod::client
