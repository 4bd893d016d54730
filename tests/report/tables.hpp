#pragma once

#include "report/findings.hpp"

namespace slod::report {

/// "at most 0.1", "at least 3", "1 to 2"; empty without limits.
std::string limit_text(const test::CaseLimits& limits);

/// With four digits.
std::string value_text(double value);

/// "Suite.Name", and how many of its runs failed or that it did not end.
std::string test_text(const TestFindings& test);

/// For a terminal, with problems and a summary at its end.
std::string table_text(const Findings& findings);

/// With commas between cells: a line for each measured value, and one for each case without.
std::string csv_text(const Findings& findings);

} // namespace slod::report
