#include "idl/duration_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

namespace slod {
namespace {

constexpr std::size_t buckets_per_octave = 64;
constexpr int leading_bits = 7; ///< of a duration: they choose its bucket
constexpr std::uint64_t longest_ns = 1'000'000'000'000'000'000;

/// Below 128 ns every nanosecond has a bucket.
constexpr std::size_t bucket_of(std::uint64_t nanoseconds)
{
    const int shift = std::max(0, int(std::bit_width(nanoseconds)) - leading_bits);
    return std::size_t(shift) * buckets_per_octave + std::size_t(nanoseconds >> shift);
}

constexpr std::size_t last_bucket = bucket_of(longest_ns);

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

DurationHistogram::DurationHistogram(const Counts& counts)
{
    for (const auto& [bucket, count] : counts) {
        if (bucket > last_bucket)
            throw std::out_of_range("no duration is in bucket " + std::to_string(bucket));
        add(bucket, count);
    }
}

void DurationHistogram::add(std::size_t bucket, std::uint64_t count)
{
    if (bucket >= counts_.size())
        counts_.resize(bucket + 1);
    counts_[bucket] += count;
    total_ += count;
}

void DurationHistogram::add(double milliseconds)
{
    add(bucket_of(std::uint64_t(std::clamp(milliseconds * 1e6, 0.0, double(longest_ns)))), 1);
}

void DurationHistogram::add(const DurationHistogram& other)
{
    for (std::size_t bucket = 0; bucket < other.counts_.size(); ++bucket)
        add(bucket, other.counts_[bucket]);
}

DurationHistogram::Counts DurationHistogram::counts() const
{
    Counts counts;
    for (std::size_t bucket = 0; bucket < counts_.size(); ++bucket)
        if (counts_[bucket] > 0)
            counts.emplace(bucket, counts_[bucket]);
    return counts;
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
