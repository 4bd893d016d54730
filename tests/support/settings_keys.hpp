#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "core/settings.hpp"
#include "core/vectors.hpp"
#include "scene/sections.hpp"

namespace slod::test {

/// What a setting of this one's type may be given that is no number, as in a scene file; nothing for one that
/// is none itself. `inf` where that is no mistake is left out.
template <class T>
std::vector<std::string> no_numbers(const Field& field, const T&)
{
    std::vector<std::string> values;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
        values = {"nan", "-nan", "-inf"};
        if (!field.infinity_allowed)
            values.emplace_back("inf");
    } else if constexpr (std::is_same_v<T, Vector3d>) {
        for (const std::string value : {"nan", "inf", "-inf"})
            for (const std::string& vector :
                 {"[" + value + ", 0.0, 1.0]", "[0.0, " + value + ", 1.0]", "[0.0, 1.0, " + value + "]"})
                if (!(field.infinity_allowed && value == "inf"))
                    values.push_back(vector);
    } else if constexpr (std::is_same_v<T, NumberPairs>) {
        for (const std::string value : {"nan", "inf", "-inf"})
            for (const std::string& pair : {"[[" + value + ", 1.0]]", "[[0.0, " + value + "]]"})
                values.push_back(pair);
    }
    return values;
}

/// Makes all effects that can be there once be there, so that they have keys.
inline void name_all(SimulationSettings& settings)
{
    for_each_section(settings, []<class Table>(const Section&, Table& table) {
        if constexpr (requires { table.has_value(); })
            table.emplace();
    });
}

/// Calls visit(key, field, value) for each setting in the sections of `settings`, `table.key`; of [[tables]],
/// for each element that is there, `table.0.key`.
template <class Settings, class Visitor>
void for_each_key(Settings& settings, const Visitor& visit)
{
    const auto add = [&](const std::string& prefix, auto& table) {
        for_each_field(table, [&](const Field& field, const auto& value) {
            visit(prefix + std::string(field.key), field, value);
        });
    };
    for_each_section(settings, [&]<class Table>(const Section& section, Table& table) {
        const std::string name(section.name);
        if constexpr (requires { table.at(0); }) {
            for (std::size_t i = 0; i < table.size(); ++i)
                add(name + "." + std::to_string(i) + ".", table[i]);
        } else if constexpr (requires { table.value(); }) {
            if (table)
                add(name + ".", *table);
        } else {
            add(name.empty() ? "" : name + ".", table);
        }
    });
}

} // namespace slod::test
