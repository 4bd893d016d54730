#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace slod::stress {

/// Samples of one topic and region that one reader got. Their writer numbers them.
struct Span {
    std::uint64_t first = 0;    ///< number of the first one received
    std::uint64_t last = 0;     ///< of the last one
    std::uint64_t received = 0; ///< with both
};

/// What one reader got of the streams of all regions. A region that goes and comes again is numbered anew,
/// as another stream.
class StreamTally {
public:
    void on_sample(const std::string& region, std::uint64_t serial);

    std::uint64_t received() const { return received_; }

    /// Sent between the first and the last one received of each stream, both included.
    std::uint64_t sent() const { return sent_; }

    /// Of the streams that go on, by region.
    const std::map<std::string, Span>& open() const { return open_; }

private:
    std::map<std::string, Span> open_;
    std::uint64_t received_ = 0, sent_ = 0;
};

/// Share of what was sent to a reader that it received: `latest` has the highest number of each stream that
/// any reader got, so that a reader whose stream ended early has lost the rest. 1 when nothing was sent.
double delivered_share(std::uint64_t received, std::uint64_t sent, const std::map<std::string, Span>& open,
                       const std::map<std::string, Span>& latest);

} // namespace slod::stress
