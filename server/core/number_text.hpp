#pragma once

#include <string>

namespace slod {

/// The shortest decimal that reads back as the same number: "0.1", "10", "1e+30", "inf".
std::string number_text(double value);

} // namespace slod
