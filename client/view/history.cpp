#include "view/history.hpp"

namespace slod::view {

void History::add(const client::ServerStats& stats, const client::MeasuredError* error)
{
    if (stats.frame == last_frame_)
        return;
    last_frame_ = stats.frame;
    append("frame_rate_hz", stats.frame_rate_hz);
    append("work_ms", stats.work_ms);
    append("real_time_factor", stats.real_time_factor);
    if (error) {
        append("error_percent", 100 * error->median.value);
        append("error_low", 100 * error->median.low);
        append("error_high", 100 * error->median.high);
    }
    phases_.clear();
    for (const auto& [phase, ms] : stats.phases_ms) {
        append(phase, ms);
        phases_.push_back(phase);
    }
}

void History::reset()
{
    last_frame_ = 0;
    series_.clear();
    phases_.clear();
}

void History::append(const std::string& name, double value)
{
    std::vector<float>& values = series_[name];
    if (values.size() == length)
        values.erase(values.begin());
    values.push_back(float(value));
}

} // namespace slod::view
