#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slod {

/// The distribution of durations over a run of any length, in 30 KB: counts in buckets that are linear
/// within each power of two of nanoseconds (after HdrHistogram). A quantile is right to 1/128 of its value.
class DurationHistogram {
public:
    /// Counts one duration; below 0 is taken as 0.
    void add(double milliseconds);

    std::uint64_t count() const { return total_; }

    /// The duration in milliseconds that `share`, in (0, 1], of all durations do not exceed (nearest rank);
    /// 0 when there are none.
    double quantile(double share) const;

private:
    std::vector<std::uint64_t> counts_;
    std::uint64_t total_ = 0;
};

} // namespace slod
