#include "stress/stream_tally.hpp"

namespace slod::stress {

void StreamTally::on_sample(const std::string& region, std::uint64_t serial)
{
    Span& span = open_[region];
    const bool another_stream = span.received == 0 || serial <= span.last;
    if (another_stream)
        span = {.first = serial, .last = serial};
    sent_ += another_stream ? 1 : serial - span.last;
    span.last = serial;
    ++span.received;
    ++received_;
}

double delivered_share(std::uint64_t received, std::uint64_t sent, const std::map<std::string, Span>& open,
                       const std::map<std::string, Span>& latest)
{
    for (const auto& [region, span] : open) {
        const auto known = latest.find(region);
        if (known != latest.end() && known->second.last > span.last)
            sent += known->second.last - span.last;
    }
    return sent > 0 ? double(received) / double(sent) : 1;
}

} // namespace slod::stress
