#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace slod {

/// JSON as text: in one line, or with `indent` spaces for each level. What is not UTF-8 in it, such as a
/// file's name, is replaced by U+FFFD rather than refused.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1)
{
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace slod
