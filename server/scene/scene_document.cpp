#include "scene/scene_document.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "scene/nearest.hpp"
#include "scene/sections.hpp"
#include "scene/value_text.hpp"

namespace slod {

namespace {

std::optional<toml::table> parse_text(const SceneText& scene, Problems& found)
{
    try {
        return toml::parse(scene.text, scene.name);
    } catch (const toml::parse_error& failure) {
        found.push_back(scene.name + ":" + std::to_string(failure.source().begin.line) +
                        ": not TOML: " + std::string(failure.description()) + ".");
        return {};
    }
}

bool is_bare_key(std::string_view key)
{
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !key.empty() && key.find_first_not_of(allowed) == std::string_view::npos;
}

/// An override taken apart: [table.[index.]]key = value.
struct Override {
    std::string origin; ///< as the user wrote it
    std::string table, index, key, value;
};

std::optional<Override> split(const std::string& text)
{
    Override result{
        .origin = std::string(override_mark) + text, .table = {}, .index = {}, .key = {}, .value = {}};
    const auto equals = text.find('=');
    if (equals == std::string::npos)
        return {};
    result.value = text.substr(equals + 1);

    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= equals;) {
        const auto end = std::min(text.find('.', begin), equals);
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    for (const std::string& part : parts)
        if (!is_bare_key(part))
            return {};
    if (parts.size() > 3)
        return {};
    result.key = parts.back();
    if (parts.size() > 1)
        result.table = parts.front();
    if (parts.size() > 2)
        result.index = parts[1];
    return result;
}

std::vector<std::string> table_names()
{
    std::vector<std::string> names;
    Scene scene;
    for_each_section(scene, [&](const Section& section, const auto&) {
        if (!section.name.empty())
            names.emplace_back(section.name);
    });
    return names;
}

/// Why there is no element for the override in an array of `count` tables.
std::string missing_element(const Override& change, std::size_t count)
{
    const std::string table = "[[" + change.table + "]]";
    const std::vector<std::string> known = table_names();
    if (count == 0 && std::find(known.begin(), known.end(), change.table) == known.end())
        return table + " is no table of a scene; " + suggestion(change.table, known);
    return "there is no " + table + " number " + change.index + "; the scene has " + std::to_string(count) +
           (count > 0 ? ", counted from 0." : ".");
}

/// The table that an override names; none, with a problem, when it cannot be reached.
toml::table* table_of(toml::table& root, const Override& change, Problems& found)
{
    if (change.table.empty())
        return &root;
    toml::node* const node = root.get(change.table);
    if (change.index.empty()) {
        if (node->is_array())
            found.push_back(change.origin + ": [[" + change.table + "]] is an array of tables; write " +
                            change.table + ".0." + change.key + " for the first.");
        else if (!node->is_table())
            found.push_back(change.origin + ": " + change.table + " is no table; leave out ." + change.key +
                            ".");
        return node->as_table();
    }
    const std::size_t count = node != nullptr && node->is_array_of_tables() ? node->as_array()->size() : 0;
    const bool is_number = change.index.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t index = is_number && change.index.size() < 10 ? std::stoul(change.index) : count;
    if (index < count)
        return node->as_array()->get(index)->as_table();
    found.push_back(change.origin + ": " + missing_element(change, count));
    return nullptr;
}

void apply(toml::table& root, const std::string& text, Problems& found)
{
    const auto change = split(text);
    if (!change) {
        found.push_back(
            std::string(override_mark) + text +
            ": not understood; write table.key=value, or table.0.key=value for an array of tables.");
        return;
    }
    try {
        if (!change->table.empty() && change->index.empty() && !root.contains(change->table)) {
            toml::table whole =
                parse_assignment(change->table + "." + change->key, change->value, change->origin);
            root.insert_or_assign(change->table, std::move(*whole.get(change->table)->as_table()));
            return;
        }
        toml::table leaf = parse_assignment(change->key, change->value, change->origin);
        toml::table* const table = table_of(root, *change, found);
        if (table != nullptr)
            table->insert_or_assign(change->key, std::move(*leaf.get(change->key)));
    } catch (const toml::parse_error& failure) {
        found.push_back(change->origin + ": the value is not TOML: " + std::string(failure.description()) +
                        ".");
    }
}

std::string array_text(const toml::array& array)
{
    constexpr std::size_t longest = 8;
    if (array.size() > longest)
        return "an array of " + std::to_string(array.size());
    std::vector<std::string> items;
    for (const toml::node& item : array)
        items.push_back(item.is_array() ? "[...]" : node_text(item));
    return "[" + joined(items) + "]";
}

} // namespace

std::string where(const toml::node& node)
{
    const toml::source_region& source = node.source();
    const std::string path = source.path ? *source.path : std::string();
    if (path.starts_with(override_mark))
        return path;
    return path + ":" + std::to_string(source.begin.line);
}

std::string node_text(const toml::node& node)
{
    if (const auto* text = node.as_string())
        return string_text(text->get());
    if (const auto* integer = node.as_integer())
        return std::to_string(integer->get());
    if (const auto* number = node.as_floating_point())
        return float_text(number->get());
    if (const auto* boolean = node.as_boolean())
        return boolean->get() ? "true" : "false";
    if (const auto* array = node.as_array())
        return array_text(*array);
    return node.is_table() ? "a table" : "a date or time";
}

toml::table parse_assignment(const std::string& key, const std::string& value, const std::string& origin)
{
    constexpr std::string_view starts_of_toml = "\"'[{";
    const bool one_line = value.find_first_of("\r\n") == std::string::npos;
    const bool surely_toml = !value.empty() && starts_of_toml.find(value[0]) != std::string_view::npos;
    try {
        if (one_line)
            return toml::parse(key + " = " + value, origin);
    } catch (const toml::parse_error&) {
        if (surely_toml)
            throw;
    }
    return toml::parse(key + " = " + string_text(value), origin);
}

Problems one_line_each(Problems found)
{
    for (std::string& problem : found)
        std::replace_if(
            problem.begin(), problem.end(),
            [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return found;
}

std::variant<SceneText, Problems> read_scene_text(const std::filesystem::path& file)
{
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    std::string why;
    std::string text;
    if (!std::filesystem::exists(status)) {
        why = "there is no such file; name a scene file.";
    } else if (std::filesystem::is_directory(status)) {
        why = "this is a folder; name a scene file in it.";
    } else {
        std::ifstream stream(file, std::ios::binary);
        std::array<char, 1U << 14> chunk{};
        while (text.size() <= max_scene_file_bytes && stream.read(chunk.data(), chunk.size()).gcount() > 0)
            text.append(chunk.data(), std::size_t(stream.gcount()));
        if (!stream.is_open() || stream.bad())
            why = "the file cannot be read; check its permissions.";
        else if (text.size() > max_scene_file_bytes)
            why = "longer than " + std::to_string(max_scene_file_bytes) + " bytes; name a scene file.";
    }
    if (!why.empty())
        return one_line_each({file.string() + ": " + why});
    return SceneText{.name = file.string(), .text = std::move(text), .folder = file.parent_path()};
}

std::optional<toml::table> read_document(const SceneText& scene, const std::vector<std::string>& overrides,
                                         Problems& found)
{
    auto root = parse_text(scene, found);
    if (root)
        for (const std::string& text : overrides)
            apply(*root, text, found);
    return root;
}

} // namespace slod
