#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace slod {

/// The distribution of durations over a run of any length, in 30 KB: counts in buckets that are linear
/// within each power of two of nanoseconds (after HdrHistogram). A quantile is right to 1/128 of its value.
/// Histograms of several processes add up.
class DurationHistogram {
public:
    /// Counts that are not 0 by bucket, in the order of the durations: how a histogram travels.
    using Counts = std::map<std::size_t, std::uint64_t>;

    DurationHistogram() = default;

    /// What counts() gave. Throws std::out_of_range for a bucket that no duration has.
    explicit DurationHistogram(const Counts& counts);

    /// Counts one duration; below 0 is taken as 0, and beyond some thirty years as those.
    void add(double milliseconds);

    void add(const DurationHistogram& other);

    std::uint64_t count() const { return total_; }
    Counts counts() const;

    /// The duration in milliseconds that `share`, in (0, 1], of all durations do not exceed (nearest rank);
    /// 0 when there are none.
    double quantile(double share) const;

private:
    void add(std::size_t bucket, std::uint64_t count);

    std::vector<std::uint64_t> counts_; ///< by bucket, up to the last that is not 0
    std::uint64_t total_ = 0;
};

} // namespace slod
