#include "common/stream_meter.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace slod::client {

namespace {

/// Nearest-rank percentile of sorted values; 0 when there are none.
double percentile(std::span<const double> sorted, double share)
{
    if (sorted.empty())
        return 0;
    const auto rank = static_cast<std::size_t>(std::ceil(share * double(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

} // namespace

void StreamMeter::on_sample(std::string_view stream, std::uint64_t serial, std::size_t bytes,
                            std::chrono::nanoseconds latency, Clock::time_point now)
{
    const auto known = last_serial_.find(stream);
    if (known == last_serial_.end()) {
        last_serial_.emplace(stream, serial);
    } else {
        if (serial > known->second)
            lost_ += serial - known->second - 1;
        known->second = serial;
    }
    arrivals_[received_ % remembered] = {.when = now,
                                         .bytes = bytes,
                                         .latency_ms =
                                             std::chrono::duration<double, std::milli>(latency).count()};
    ++received_;
    bytes_ += bytes;
}

StreamMeter::Report StreamMeter::report(Clock::time_point now) const
{
    constexpr std::chrono::seconds window{2};
    Report report{.received = received_, .lost = lost_, .bytes = bytes_};
    std::array<double, remembered> latencies;
    std::size_t count = 0;
    std::size_t window_bytes = 0;
    Clock::time_point first{}, last{};
    Clock::duration longest_gap{};
    for (; count < std::min<std::uint64_t>(received_, remembered); ++count) {
        const Arrival& arrival = arrivals_[(received_ - 1 - count) % remembered];
        if (arrival.when < now - window)
            break;
        latencies[count] = arrival.latency_ms;
        window_bytes += arrival.bytes;
        if (count > 0)
            longest_gap = std::max(longest_gap, first - arrival.when);
        first = arrival.when;
        last = std::max(last, arrival.when);
    }
    const std::span<double> sorted(latencies.data(), count);
    std::sort(sorted.begin(), sorted.end());
    report.longest_gap_ms = std::chrono::duration<double, std::milli>(longest_gap).count();
    report.latency_p50_ms = percentile(sorted, 0.5);
    report.latency_p99_ms = percentile(sorted, 0.99);
    const double seconds = std::chrono::duration<double>(last - first).count();
    if (count > 1 && seconds > 0) {
        report.rate_hz = double(count - 1) / seconds;
        report.bytes_per_s = report.rate_hz * double(window_bytes) / double(count);
    }
    return report;
}

} // namespace slod::client
