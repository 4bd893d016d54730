#pragma once

#include <nlohmann/json.hpp>

namespace slod::stress {

using Json = nlohmann::ordered_json; ///< keeps the order in which fields are written

} // namespace slod::stress
