#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <string>

#include "core/settings.hpp"
#include "core/vectors.hpp"
#include "scene/nearest.hpp"
#include "scene/toml.hpp"
#include "scene/value_text.hpp"

namespace slod {

/// What is wrong with a value, to follow "key = value "; empty when it was taken.
using Complaint = std::string;

Complaint assign(bool& target, const Field& field, const toml::node& node);
Complaint assign(double& target, const Field& field, const toml::node& node);
Complaint assign(std::string& target, const Field& field, const toml::node& node);
Complaint assign(Vector3d& target, const Field& field, const toml::node& node);
Complaint assign(NumberPairs& target, const Field& field, const toml::node& node);

template <std::integral T>
Complaint assign(T& target, const Field& field, const toml::node& node)
{
    const Range range = range_of<T>(field);
    const auto* integer = node.as_integer();
    if (integer == nullptr)
        return "is no integer; use " + range_text(range, false) + ", without point or exponent.";
    if (!range.contains(double(integer->get())))
        return "is out of range; use " + range_text(range, false) + ".";
    target = T(integer->get());
    return {};
}

template <class E>
requires std::is_enum_v<E> Complaint assign(E& target, const Field&, const toml::node& node)
{
    const auto all = names(E{});
    const auto* text = node.as_string();
    if (text == nullptr)
        return "is no string; use one of " + joined(all) + ".";
    const auto found = std::find(all.begin(), all.end(), text->get());
    if (found == all.end())
        return "is not one of its values; " + suggestion(text->get(), {all.begin(), all.end()});
    target = E(found - all.begin());
    return {};
}

} // namespace slod
