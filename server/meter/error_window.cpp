#include "meter/error_window.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "meter/order_statistics.hpp"

namespace slod {
namespace {

ErrorQuantile quantile(std::span<const double> sorted, double q)
{
    const QuantileRanks ranks = ranks_around(q, sorted.size());
    const auto place = std::min(std::size_t(q * double(sorted.size())), sorted.size() - 1);
    return {sorted[place], sorted[ranks.low], sorted[ranks.high]};
}

} // namespace

void ErrorWindow::add(const ErrorSample& sample)
{
    if (samples_.size() < capacity_) {
        samples_.push_back(sample);
        return;
    }
    samples_[next_] = sample;
    next_ = (next_ + 1) % capacity_;
}

void ErrorWindow::clear()
{
    samples_.clear();
    next_ = 0;
}

ErrorEstimate ErrorWindow::estimate() const
{
    ErrorEstimate estimate;
    estimate.samples = samples_.size();
    if (samples_.empty())
        return estimate;
    std::vector<double> sorted;
    double squares = 0;
    estimate.oldest_frame = estimate.newest_frame = samples_.front().frame;
    for (const ErrorSample& sample : samples_) {
        sorted.push_back(sample.error);
        squares += sample.error * sample.error;
        estimate.oldest_frame = std::min(estimate.oldest_frame, sample.frame);
        estimate.newest_frame = std::max(estimate.newest_frame, sample.frame);
    }
    std::sort(sorted.begin(), sorted.end());
    estimate.median = quantile(sorted, 0.5);
    estimate.p90 = quantile(sorted, 0.9);
    estimate.p99 = quantile(sorted, 0.99);
    estimate.max = sorted.back();
    estimate.rms = std::sqrt(squares / double(sorted.size()));
    return estimate;
}

} // namespace slod
