#include "app/settings_json.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/json_text.hpp"
#include "scene/sections.hpp"

namespace slod {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(value > 0 ? "inf" : "-inf");
}

template <class T>
Json value_json(const T& value)
{
    if constexpr (std::is_enum_v<T>)
        return names(value)[std::size_t(value)];
    else if constexpr (std::is_same_v<T, Vector3d>)
        return {number(value.x()), number(value.y()), number(value.z())};
    else if constexpr (std::is_floating_point_v<T>)
        return number(value);
    else
        return value;
}

template <class Settings>
Json table_json(Settings& settings)
{
    Json table = Json::object();
    for_each_field(settings, [&](const Field& field, const auto& value) {
        table[std::string(field.key)] = value_json(value);
    });
    return table;
}

/// Adds a section to the whole: a struct, an effect that may be absent, or a list.
struct AddSection {
    Json& all;

    template <class Settings>
    void operator()(const Section& section, Settings& settings) const
    {
        if (section.name.empty())
            all.update(table_json(settings));
        else
            all[std::string(section.name)] = table_json(settings);
    }

    template <class Settings>
    void operator()(const Section& section, std::optional<Settings>& settings) const
    {
        if (settings)
            (*this)(section, *settings);
    }

    template <class Settings>
    void operator()(const Section& section, std::vector<Settings>& list) const
    {
        Json& array = all[std::string(section.name)] = Json::array();
        for (Settings& settings : list)
            array.push_back(table_json(settings));
    }
};

std::string record(const std::string& table, const Json& settings)
{
    std::string line = "settings table=" + table;
    for (const auto& [key, value] : settings.items())
        line += " " + key + "=" + json_text(value);
    return line;
}

} // namespace

Json settings_json(const Scene& scene)
{
    Scene copy = scene; // the visitor is shared with the reader, which writes
    if (auto& gravity = copy.simulation.gravity)
        gravity = with_accuracy(*gravity);
    Json all = Json::object();
    for_each_section(copy, AddSection{all});
    return all;
}

std::vector<std::string> settings_records(const Scene& scene)
{
    std::vector<std::string> records;
    const Json all = settings_json(scene);
    for (const auto& [table, content] : all.items()) {
        if (content.is_object())
            records.push_back(record(table, content));
        else if (content.is_array())
            for (const Json& element : content)
                records.push_back(record(table, element));
    }
    return records;
}

} // namespace slod
