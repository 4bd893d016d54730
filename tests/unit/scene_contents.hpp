#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

#include "scene/sections.hpp"

// What a scene says, for comparison.
namespace slod::test {

/// A value by its bits, so that equal means the same number and nothing less.
template <class T>
std::string bits_of(const T& value)
{
    if constexpr (std::is_same_v<T, std::string>)
        return value;
    else if constexpr (std::is_same_v<T, double>)
        return std::to_string(std::bit_cast<std::uint64_t>(value));
    else if constexpr (std::is_same_v<T, Vector3d>)
        return bits_of(value.x()) + " " + bits_of(value.y()) + " " + bits_of(value.z());
    else if constexpr (std::is_same_v<T, NumberPairs>) {
        std::string all;
        for (const auto& [first, second] : value)
            all += bits_of(first) + " " + bits_of(second) + " ";
        return all;
    } else
        return std::to_string(std::uint64_t(value));
}

/// All that a scene says, by key; an absent effect has no keys.
inline std::map<std::string, std::string> contents(Scene scene)
{
    std::map<std::string, std::string> all;
    const auto add = [&](const std::string& prefix, auto& settings) {
        all[prefix] = "there";
        for_each_field(settings, [&](const Field& field, const auto& value) {
            all[prefix + "." + std::string(field.key)] = bits_of(value);
        });
    };
    for_each_section(scene, [&]<class Settings>(const Section& section, Settings& settings) {
        const std::string name(section.name);
        if constexpr (requires { settings.at(0); }) {
            for (std::size_t i = 0; i < settings.size(); ++i)
                add(name + "." + std::to_string(i), settings[i]);
        } else if constexpr (requires { settings.value(); }) {
            if (settings)
                add(name, *settings);
        } else {
            add(name, settings);
        }
    });
    return all;
}

} // namespace slod::test
