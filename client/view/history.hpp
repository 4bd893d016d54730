#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/messages.hpp"

namespace slod::view {

/// How a server did over the last while, for plots.
class History {
public:
    static constexpr std::size_t length = 240; ///< samples kept

    /// Takes in a sample, once, and the error of accelerations then; null: it is not known.
    void add(const client::ServerStats& stats, const client::MeasuredError* error = nullptr);

    /// Oldest first: "frame_rate_hz", "work_ms", "real_time_factor", and each phase's milliseconds by its
    /// name; once the error is known, "error_percent", the median, and "error_low", "error_high", between
    /// which it is.
    const std::map<std::string, std::vector<float>>& series() const { return series_; }

    /// Names of the phases, in the frame's order.
    const std::vector<std::string>& phases() const { return phases_; }

    void reset();

private:
    void append(const std::string& name, double value);

    std::uint64_t last_frame_ = 0;
    std::map<std::string, std::vector<float>> series_;
    std::vector<std::string> phases_;
};

} // namespace slod::view
