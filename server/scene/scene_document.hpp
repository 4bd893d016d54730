#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/settings.hpp"
#include "scene/scene.hpp"
#include "scene/toml.hpp"

namespace slod {

/// Largest scene file that is read, bytes.
inline constexpr std::size_t max_scene_file_bytes = 16u << 20;

/// Starts the where() of whatever an override wrote.
inline constexpr std::string_view override_mark = "--set ";

/// Where a node was written: "file:line" or "--set table.key=value".
std::string where(const toml::node& node);

/// A node's value for a problem's sentence; tables and long arrays in short.
std::string node_text(const toml::node& node);

/// Parses "key = value" or "table.key = value". A value that is no TOML and does not look as if it was
/// meant to be (quotes, brackets) is a string. `origin` is where(), of its nodes. Throws toml::parse_error.
toml::table parse_assignment(const std::string& key, const std::string& value, const std::string& origin);

/// Names and values may hold any character; a problem is one line of a log.
Problems one_line_each(Problems found);

/// Parses a scene's text and puts the overrides in their places, each node with its own origin. Appends what
/// is wrong to `found`: nothing when the text is no TOML, else all but the faulty overrides.
std::optional<toml::table> read_document(const SceneText& scene, const std::vector<std::string>& overrides,
                                         Problems& found);

} // namespace slod
