#pragma once

#include <string_view>

namespace slod {

/// The program's version, "major.minor.patch".
std::string_view version();

} // namespace slod
