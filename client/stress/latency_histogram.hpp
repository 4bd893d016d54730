#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

namespace slod::stress {

/// The distribution of durations over a run of any length: counts in buckets that are linear within each
/// power of two of nanoseconds (after HdrHistogram). A quantile is right to 1/64 of its value. Histograms of
/// several processes add up.
class LatencyHistogram {
public:
    /// Counts by bucket, in the order of the durations.
    using Counts = std::map<std::size_t, std::uint64_t>;

    LatencyHistogram() = default;
    explicit LatencyHistogram(Counts counts);

    /// Counts one duration; below 0 is taken as 0.
    void add(double milliseconds);

    void add(const LatencyHistogram& other);

    std::uint64_t count() const { return total_; }
    const Counts& counts() const { return counts_; }

    /// The duration in milliseconds that `share`, in (0, 1], of all durations do not exceed (nearest rank);
    /// 0 when there are none.
    double quantile(double share) const;

private:
    Counts counts_;
    std::uint64_t total_ = 0;
};

} // namespace slod::stress
