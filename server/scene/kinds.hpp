#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "cluster/particles.hpp"

namespace slod {

/// The row of the kind of this name; none when the scene has no such kind.
inline std::optional<std::uint8_t> kind_index(const std::vector<ParticleKind>& kinds, std::string_view name)
{
    for (std::size_t row = 0; row < kinds.size(); ++row)
        if (kinds[row].name == name)
            return std::uint8_t(row);
    return {};
}

} // namespace slod
