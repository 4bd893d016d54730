#include "stress/latency_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace slod::stress {

namespace {

constexpr std::size_t buckets_per_octave = 32;
constexpr int leading_bits = 6; ///< of a duration: they choose its bucket
constexpr double longest_ns = 1e18;

/// Below 64 ns every nanosecond has a bucket.
std::size_t bucket_of(std::uint64_t nanoseconds)
{
    const int shift = std::max(0, int(std::bit_width(nanoseconds)) - leading_bits);
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

LatencyHistogram::LatencyHistogram(Counts counts) : counts_(std::move(counts))
{
    for (const auto& [bucket, count] : counts_)
        total_ += count;
}

void LatencyHistogram::add(double milliseconds)
{
    ++counts_[bucket_of(std::uint64_t(std::clamp(milliseconds * 1e6, 0.0, longest_ns)))];
    ++total_;
}

void LatencyHistogram::add(const LatencyHistogram& other)
{
    for (const auto& [bucket, count] : other.counts_)
        counts_[bucket] += count;
    total_ += other.total_;
}

double LatencyHistogram::quantile(double share) const
{
    const auto rank = std::uint64_t(std::ceil(share * double(total_)));
    std::uint64_t below = 0;
    for (const auto& [bucket, count] : counts_) {
        below += count;
        if (below >= rank)
            return middle_of(bucket) * 1e-6;
    }
    return 0;
}

} // namespace slod::stress
