#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cost/sweep.hpp"

namespace slod::cost {

/// The row with the least error whose frames take no more than `ms`; none when all take longer.
std::optional<Row> best_within(const std::vector<Row>& rows, double ms);

/// The fastest row whose error is no more than `error`; none when all are farther off.
std::optional<Row> fastest_within(const std::vector<Row>& rows, double error);

/// In words: for 30, 60 and 120 frames a second the settings and their error, for errors of 1, 2 and 5 noise
/// floors, and where there are accelerations for median errors of 1 % and 0.1 % of these, the settings and
/// their frame time.
std::string answer(const Sweep& sweep);

} // namespace slod::cost
