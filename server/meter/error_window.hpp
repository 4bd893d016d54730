#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slod {

/// A quantile of the errors, and two values between which it lies with 95 % probability; the smallest and the
/// largest error where there are too few for that, as for a p99 of less than 370.
struct ErrorQuantile {
    double value = 0, low = 0, high = 0;
};

/// What is known of the errors |a - exact| / |exact| of the accelerations that clusters give their members.
struct ErrorEstimate {
    std::uint64_t samples = 0;                        ///< 0: nothing is known
    std::uint64_t oldest_frame = 0, newest_frame = 0; ///< of the samples
    ErrorQuantile median, p90, p99;
    double max = 0, rms = 0;
};

/// The error of one member that was drawn, |a - exact| / |exact|.
struct ErrorSample {
    std::uint64_t frame; ///< as of the end of which it was drawn
    double error;
};

/// The last so many errors.
class ErrorWindow {
public:
    explicit ErrorWindow(std::size_t capacity) : capacity_(capacity) { samples_.reserve(capacity); }

    void add(const ErrorSample& sample);
    void clear();
    std::size_t size() const { return samples_.size(); }

    ErrorEstimate estimate() const; ///< O(n log n)

private:
    std::size_t capacity_;
    std::size_t next_ = 0; ///< to be written over, once all places are taken
    std::vector<ErrorSample> samples_;
};

} // namespace slod
