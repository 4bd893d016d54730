#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "idl/dds.hpp"

namespace slod {

/// What the publisher counts. Any thread may read it; each number has one thread that writes it.
struct PublishCounters {
    std::atomic<std::uint64_t> frames_offered{0};
    std::atomic<std::uint64_t> frames_published{0};
    std::atomic<std::uint64_t> frames_skipped{0};
    std::atomic<std::uint64_t> frames_delayed{0};
    std::atomic<std::uint64_t> samples_refused{0};
    std::atomic<std::uint64_t> bytes{0};
    std::atomic<double> encode_ms{0};

    wire::PublisherCounts message() const
    {
        return {.offered_frames = frames_offered,
                .published_frames = frames_published,
                .skipped_frames = frames_skipped,
                .refused_samples = samples_refused,
                .published_bytes = bytes,
                .delayed_frames = frames_delayed,
                .encode_ms = encode_ms};
    }
};

/// Where all samples of a publisher go out and are counted. Belongs to the publisher's thread.
class Outlet {
public:
    explicit Outlet(PublishCounters& counters) : counters_(counters) {}

    template <class Message>
    void send(wire::Writer<Message>& writer, const Message& message)
    {
        if (!writer.write(message)) {
            ++counters_.samples_refused;
            return;
        }
        const std::uint64_t bytes = wire::wire_bytes(message);
        counters_.bytes += bytes;
        largest_sample_ = std::max(largest_sample_, bytes);
    }

    template <class Message>
    void dispose(wire::Writer<Message>& writer, const Message& message)
    {
        if (!writer.dispose(message))
            ++counters_.samples_refused;
    }

    /// Disposes for good: no instance stays in memory.
    template <class Message>
    void forget(wire::Writer<Message>& writer, const Message& message)
    {
        if (!writer.forget(message))
            ++counters_.samples_refused;
    }

    PublishCounters& counters() { return counters_; }
    std::uint64_t largest_sample() const { return largest_sample_; } ///< bytes

private:
    PublishCounters& counters_;
    std::uint64_t largest_sample_ = 0;
};

} // namespace slod
