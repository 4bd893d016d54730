#pragma once

#include <string>
#include <vector>

#include "stress/report.hpp"

namespace slod::stress {

/// What gnuplot is to draw into `file`, a PNG: the distributions of latencies and round trips, and the share
/// delivered to each kind of subscriber.
std::string load_script(const Report& report, const std::string& file);

/// Likewise, against the number of subscribers: share delivered, latency, and what all of them receive.
std::string sweep_script(const std::vector<Report>& reports, const std::string& file);

/// A sweep's figures for one number of subscribers: a line of text with its end.
std::string sweep_line(const Report& report);

} // namespace slod::stress
