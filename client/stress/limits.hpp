#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stress/report.hpp"

namespace slod::stress {

/// What a run must keep to; what is not given is not judged.
struct Limits {
    std::optional<double> loss_percent{};  ///< of the samples sent to steady readers
    std::optional<double> latency_ms{};    ///< p99 of steady readers
    std::optional<double> round_trip_ms{}; ///< p99 of valid commands
    std::optional<double> processor_growth_percent{};
    std::optional<double> memory_growth_mib{};
    std::optional<double> frame_rate_hz{}; ///< at least
};

/// One thing that must be so.
struct Check {
    bool held = true;
    std::string claim; ///< a sentence without its full stop, with the figure
};

/// What must be so of every run, and what the limits ask for. A limit on what was not measured does not hold.
std::vector<Check> checks(const Report& report, const Limits& limits);

bool all_held(const std::vector<Check>& checks);

Json json_of(const std::vector<Check>& checks);
std::string text_of(const std::vector<Check>& checks);

} // namespace slod::stress
