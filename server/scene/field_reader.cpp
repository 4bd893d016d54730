#include "scene/field_reader.hpp"

#include <cmath>
#include <optional>

namespace slod {

namespace {

/// A TOML float or integer.
std::optional<double> number(const toml::node& node)
{
    if (const auto* integer = node.as_integer())
        return double(integer->get());
    if (const auto* real = node.as_floating_point())
        return real->get();
    return {};
}

/// Whether the field takes it; NaN never passes.
bool in_range(const Field& field, double value)
{
    return range_of<double>(field).contains(value) && (field.infinity_allowed || std::isfinite(value));
}

} // namespace

Complaint assign(bool& target, const Field&, const toml::node& node)
{
    const auto* boolean = node.as_boolean();
    if (boolean == nullptr)
        return "is neither true nor false; write one of them.";
    target = boolean->get();
    return {};
}

Complaint assign(double& target, const Field& field, const toml::node& node)
{
    const std::string range = range_text(range_of<double>(field), field.infinity_allowed);
    const auto value = number(node);
    if (!value)
        return "is no number; use " + range + ".";
    if (!in_range(field, *value))
        return "is out of range; use " + range + ".";
    target = *value;
    return {};
}

Complaint assign(std::string& target, const Field&, const toml::node& node)
{
    const auto* text = node.as_string();
    if (text == nullptr)
        return "is no string; write it in quotes.";
    target = text->get();
    return {};
}

Complaint assign(Vector3d& target, const Field& field, const toml::node& node)
{
    const auto* array = node.as_array();
    if (array == nullptr || array->size() != 3)
        return "is no vector; write three numbers, [x, y, z].";
    Vector3d vector;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = number(*array->get(axis));
        if (!value)
            return "is no vector of numbers; write three of them, [x, y, z].";
        if (!in_range(field, *value))
            return "is out of range; use " + range_text(range_of<double>(field), false) + " for x, y and z.";
        vector[Eigen::Index(axis)] = *value;
    }
    target = vector;
    return {};
}

Complaint assign(NumberPairs& target, const Field& field, const toml::node& node)
{
    const std::string remedy = "is no list of pairs; write [[a, b], [c, d]], with numbers.";
    const auto* list = node.as_array();
    if (list == nullptr)
        return remedy;
    NumberPairs pairs;
    for (const toml::node& element : *list) {
        const auto* pair = element.as_array();
        if (pair == nullptr || pair->size() != 2)
            return remedy;
        const auto first = number(*pair->get(0)), second = number(*pair->get(1));
        if (!first || !second)
            return remedy;
        if (!in_range(field, *first) || !in_range(field, *second))
            return "is out of range; use " + range_text(range_of<double>(field), false) + " for each number.";
        pairs.push_back({*first, *second});
    }
    target = pairs;
    return {};
}

} // namespace slod
