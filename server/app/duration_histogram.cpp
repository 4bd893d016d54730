#include "app/duration_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace slod {
namespace {

constexpr int buckets_per_octave = 64;
constexpr double longest_ns = 1e18; // some thirty years

/// Below 128 ns every nanosecond has a bucket; above, the leading seven bits choose it.
std::size_t bucket_of(std::uint64_t nanoseconds)
{
    const int shift = std::max(0, int(std::bit_width(nanoseconds)) - 7);
    return std::size_t(shift) * buckets_per_octave + std::size_t(nanoseconds >> shift);
}

/// The middle of a bucket, in nanoseconds.
double middle_of(std::size_t bucket)
{
    if (bucket < 2 * buckets_per_octave)
        return double(bucket);
    const std::size_t shift = bucket / buckets_per_octave - 1;
    const double width = std::ldexp(1.0, int(shift));
    return (double(bucket - shift * buckets_per_octave) + 0.5) * width;
}

} // namespace

void DurationHistogram::add(double milliseconds)
{
    const std::size_t bucket = bucket_of(std::uint64_t(std::clamp(milliseconds * 1e6, 0.0, longest_ns)));
    if (bucket >= counts_.size())
        counts_.resize(bucket + 1);
    ++counts_[bucket];
    ++total_;
}

double DurationHistogram::quantile(double share) const
{
    const auto rank = std::uint64_t(std::ceil(share * double(total_)));
    std::uint64_t below = 0;
    for (std::size_t bucket = 0; bucket < counts_.size(); ++bucket) {
        below += counts_[bucket];
        if (counts_[bucket] > 0 && below >= rank)
            return middle_of(bucket) * 1e-6;
    }
    return 0;
}

} // namespace slod
