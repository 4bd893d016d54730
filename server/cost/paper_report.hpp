#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cost/figure5.hpp"

namespace slod::cost {

/// A run beside the paper's figures, for a terminal, and what of claims A66 (from which size clusters pay)
/// and A67 (how speed-ups grow with the size) holds.
std::string text(const PaperRun& run, const PaperFigures& paper);

/// The same as an object.
nlohmann::ordered_json json_of(const PaperRun& run, const PaperFigures& paper);

} // namespace slod::cost
