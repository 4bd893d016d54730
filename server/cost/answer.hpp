#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cost/sweep.hpp"

namespace slod::cost {

/// Rows of the motion, and the unclustered one, that no other of them beats in both time and error, by time.
std::vector<Row> pareto_front(const std::vector<Row>& rows, Motion motion);

/// The row with the least error whose frames take no more than `ms`; none when all take longer.
std::optional<Row> best_within(const std::vector<Row>& rows, double ms);

/// The fastest row whose error is no more than `error`. There is always one: the unclustered.
std::optional<Row> fastest_within(const std::vector<Row>& rows, double error);

/// In words: for 30, 60 and 120 frames a second the settings and their error, for errors of 1, 2 and 5 noise
/// floors the settings and their frame time.
std::string answer(const Sweep& sweep);

} // namespace slod::cost
