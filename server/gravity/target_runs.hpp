#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gravity/force_view.hpp"

namespace slod {

/// Neighbouring bodies whose forces are summed together.
struct TargetRun {
    std::uint32_t first, last; ///< bodies
    std::uint32_t node;        ///< that holds them and nothing else; none when all pairs are summed
    std::uint32_t region;

    static constexpr std::uint32_t no_node = UINT32_MAX;
};

/// Appends the bodies of a region cut into blocks of `most`.
void append_blocks(const ForceView& view, std::size_t region, std::size_t most, std::vector<TargetRun>& runs);

/// Appends the bodies of a region as groups: the largest nodes of at most `most` bodies, which is no less
/// than a leaf of the view holds.
void append_groups(const ForceView& view, std::size_t region, std::size_t most, std::vector<TargetRun>& runs);

} // namespace slod
