#pragma once

#include <optional>
#include <vector>

namespace slod::test {

/// Adds an element to an effect's table, whichever sort that is.
template <class Settings>
void add_element(std::vector<Settings>& table, const Settings& element)
{
    table.push_back(element);
}

template <class Settings>
void add_element(std::optional<Settings>& table, const Settings& element)
{
    table = element;
}

} // namespace slod::test
