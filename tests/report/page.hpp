#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/findings.hpp"

namespace slod::report {

/// A page that needs no other file. `pictures` are SVG as gnuplot writes it, those of a case under its
/// number.
std::string html_page(const Findings& findings,
                      const std::vector<std::pair<std::string, std::string>>& pictures,
                      const std::string& circumstances);

} // namespace slod::report
