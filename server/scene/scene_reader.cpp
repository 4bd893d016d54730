#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "scene/field_reader.hpp"
#include "scene/scene.hpp"
#include "scene/scene_check.hpp"
#include "scene/scene_document.hpp"
#include "scene/sections.hpp"
#include "scene/surfaces.hpp"

namespace slod {

namespace {

/// Fills settings from TOML tables and remembers where each key was written.
class SceneReader {
public:
    explicit SceneReader(Problems found) : found_(std::move(found)) {}

    void read(const toml::table& root, Scene& scene)
    {
        std::vector<std::string> keys, tables;
        for_each_section(scene, [&]<class Settings>(const Section& section, Settings& settings) {
            if constexpr (std::is_same_v<Settings, TopLevel>) {
                keys = read_fields(root, "", settings);
            } else {
                tables.emplace_back(section.name);
                if (const toml::node* const node = root.get(section.name))
                    read_section(*node, std::string(section.name), settings);
            }
        });
        refuse_unknown(root, keys, tables);
    }

    /// Adds problems of the whole, each with the place of the key that it starts with, unless that key is
    /// faulty by itself.
    void add(const Problems& of_scene, const std::string& file)
    {
        for (const std::string& problem : of_scene) {
            const std::string key = problem.substr(0, problem.find_first_of(" :"));
            if (!faulty_.contains(key))
                found_.push_back(place(key, file) + ": " + problem);
        }
    }

    Problems& found() { return found_; }

private:
    /// Reads each of the settings' keys that the table has, under `prefix`; returns the keys.
    template <class Settings>
    std::vector<std::string> read_fields(const toml::table& table, const std::string& prefix,
                                         Settings& settings)
    {
        std::vector<std::string> keys;
        for_each_field(settings, [&](const Field& field, auto& target) {
            keys.emplace_back(field.key);
            const toml::node* const node = table.get(field.key);
            if (node == nullptr)
                return;
            const std::string path = prefix + keys.back();
            places_[path] = where(*node);
            const Complaint complaint = assign(target, field, *node);
            if (!complaint.empty())
                refuse(*node, path, complaint);
        });
        return keys;
    }

    template <class Settings>
    void read_section(const toml::node& node, const std::string& path, Settings& settings)
    {
        places_[path] = where(node);
        const toml::table* const table = node.as_table();
        if (table == nullptr)
            return refuse(node, path, "is no table; write [" + path + "].");
        const auto keys = read_fields(*table, path + ".", settings);
        for (const auto& [name, value] : *table)
            if (!contains(keys, name))
                refuse(value, path + "." + std::string(name),
                       "is no key of [" + path + "]; " + suggestion(name, keys));
    }

    template <class Settings>
    void read_section(const toml::node& node, const std::string& path, std::optional<Settings>& settings)
    {
        settings.emplace();
        read_section(node, path, *settings);
    }

    template <class Settings>
    void read_section(const toml::node& node, const std::string& path, std::vector<Settings>& settings)
    {
        const toml::array* const array = node.as_array();
        if (array == nullptr || (!array->empty() && !array->is_array_of_tables()))
            return refuse(node, path, "is no array of tables; write [[" + path + "]].");
        for (std::size_t index = 0; index < array->size(); ++index) {
            settings.emplace_back();
            read_section(*array->get(index), path + "." + std::to_string(index), settings.back());
        }
    }

    void refuse_unknown(const toml::table& root, const std::vector<std::string>& keys,
                        const std::vector<std::string>& tables)
    {
        for (const auto& [name, node] : root) {
            if (contains(keys, name) || contains(tables, name))
                continue;
            if (node.is_value())
                refuse(node, std::string(name),
                       "is no key before the first table; " + suggestion(name, keys));
            else
                found_.push_back(where(node) + ": [" + std::string(name) + "] is no table of a scene; " +
                                 suggestion(name, tables));
        }
    }

    void refuse(const toml::node& node, const std::string& path, const Complaint& complaint)
    {
        faulty_.insert(path);
        found_.push_back(where(node) + ": " + path + " = " + node_text(node) + " " + complaint);
    }

    static bool contains(const std::vector<std::string>& list, std::string_view name)
    {
        return std::find(list.begin(), list.end(), name) != list.end();
    }

    /// Where `key`, or else the table around it, was written.
    std::string place(std::string key, const std::string& file) const
    {
        for (;;) {
            if (const auto found = places_.find(key); found != places_.end())
                return found->second;
            const auto dot = key.rfind('.');
            if (dot == std::string::npos)
                return file;
            key.resize(dot);
        }
    }

    Problems found_;
    std::map<std::string, std::string> places_;
    std::set<std::string> faulty_;
};

std::variant<Scene, Problems> read_scene(const SceneText& text, const std::vector<std::string>& overrides)
{
    Problems found;
    const auto document = read_document(text, overrides, found);
    if (!document)
        return one_line_each(std::move(found));

    Scene scene;
    SceneReader reader(std::move(found));
    reader.read(*document, scene);
    reader.add(load_surfaces(scene.simulation.colliders, text.folder), text.name);
    reader.add(problems(scene), text.name);
    if (!reader.found().empty())
        return one_line_each(std::move(reader.found()));
    return scene;
}

/// What is wrong at a line of the file may be so for an override elsewhere, to which it is owed if it is gone
/// without that. Names those overrides in front.
void name_causes(Problems& found, const SceneText& text, const std::vector<std::string>& overrides)
{
    const auto names_one = [](const std::string& problem) { return problem.starts_with(override_mark); };
    if (std::all_of(found.begin(), found.end(), names_one))
        return;
    Problems causes(found.size());
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        std::vector<std::string> others = overrides;
        others.erase(others.begin() + std::ptrdiff_t(i));
        const auto without = read_scene(text, others);
        const auto* const left = std::get_if<Problems>(&without);
        for (std::size_t at = 0; at < found.size(); ++at)
            if (left == nullptr || std::find(left->begin(), left->end(), found[at]) == left->end())
                causes[at] += std::string(override_mark) + overrides[i] + ", ";
    }
    for (std::size_t at = 0; at < found.size(); ++at)
        if (!causes[at].empty() && !names_one(found[at]))
            found[at].insert(0, causes[at] + "beside ");
}

/// The line that a problem, "file:12: what", names; the largest number where it names none.
unsigned long line_of(const std::string& problem)
{
    const std::size_t end = problem.find(": ");
    const std::size_t colon = end == std::string::npos ? end : problem.rfind(':', end - 1);
    unsigned long line = std::numeric_limits<unsigned long>::max();
    if (colon != std::string::npos)
        std::from_chars(problem.data() + colon + 1, problem.data() + end, line);
    return line;
}

} // namespace

std::variant<Scene, Problems> load_scene(const SceneText& text, const std::vector<std::string>& overrides)
{
    auto read = read_scene(text, overrides);
    if (auto* const found = std::get_if<Problems>(&read)) {
        name_causes(*found, text, overrides);
        *found = one_line_each(std::move(*found));
        std::stable_sort(found->begin(), found->end(),
                         [](const std::string& a, const std::string& b) { return line_of(a) < line_of(b); });
    }
    return read;
}

std::variant<Scene, Problems> load_scene(const std::filesystem::path& file,
                                         const std::vector<std::string>& overrides)
{
    const auto text = read_scene_text(file);
    if (const auto* found = std::get_if<Problems>(&text))
        return *found;
    return load_scene(std::get<SceneText>(text), overrides);
}

} // namespace slod
