#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/settings.hpp"
#include "scene/toml.hpp"

namespace slod {

/// Largest scene file that is read, bytes.
inline constexpr std::uintmax_t max_scene_file_bytes = 16u << 20;

/// Where a node was written: "file:line" or "--set table.key=value".
std::string where(const toml::node& node);

/// A node's value for a problem's sentence; tables and long arrays in short.
std::string node_text(const toml::node& node);

/// Parses "key = value" or "table.key = value". A value that is no TOML and does not look as if it was
/// meant to be (quotes, brackets) is a string. `origin` is where(), of its nodes. Throws toml::parse_error.
toml::table parse_assignment(const std::string& key, const std::string& value, const std::string& origin);

/// Parses a scene file and puts the overrides in their places, each node with its own origin. Appends what
/// is wrong to `found`: nothing when the file cannot be read as TOML, else all but the faulty overrides.
std::optional<toml::table> read_document(const std::filesystem::path& file,
                                         const std::vector<std::string>& overrides, Problems& found);

} // namespace slod
