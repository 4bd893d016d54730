#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/settings.hpp"

namespace slod {

/// A key of a table with a `shape` that some of its shapes have.
struct ShapeKey {
    std::string_view key;
    bool given; ///< other than its default, which says nothing
    bool had;   ///< by the table's shape
};

/// Says of each key that is given though the shape has none that it is of no use.
inline void refuse_unused(std::span<const ShapeKey> keys, std::string_view shape, Problems& found)
{
    for (const ShapeKey& each : keys)
        if (each.given && !each.had)
            found.push_back(std::string(each.key) + " is no key of shape = \"" + std::string(shape) +
                            "\"; leave it out, or choose a shape that has it.");
}

} // namespace slod
