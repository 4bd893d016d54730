#pragma once

#include <string_view>

namespace slod::client {

/// Version of the clients, as in their --version.
std::string_view version();

} // namespace slod::client
