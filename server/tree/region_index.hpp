#pragma once

#include <cstdint>
#include <vector>

#include "tree/region.hpp"
#include "tree/region_grid.hpp"

namespace slod {

/// Row of a region in the SLOD-tree; the background's is 0.
using RegionRow = std::uint16_t;
inline constexpr RegionRow background_row = 0;

/// Which region takes what is at a place: the regions in their order of precedence, and coarse grids that
/// name those which reach into each of their cells, so that a thousand small regions cost what one does. Up
/// to three, of cells as wide as the small, the median and the large regions, so that regions of any size
/// reach into few.
class RegionIndex {
public:
    struct Entry {
        RegionRow row;
        RegionTest test;
    };

    /// Takes the regions in order of precedence, highest first; without the background.
    void assign(std::vector<Entry> in_order);

    /// The first region that contains the subject, or else the background. `tests` (may be null) is raised
    /// by the boundary tests that were needed.
    RegionRow find(const Subject& subject, std::uint64_t* tests = nullptr) const;

    /// Whether part of the box may belong to another region than the one in `row`, which holds it.
    bool contested(const Box& box, RegionRow row) const;

    bool empty() const { return entries_.empty(); }
    const std::vector<Entry>& entries() const { return entries_; }

private:
    void lay_grids();

    /// Whether `holds(rank)` is true of any region that may reach into the box.
    template <class Condition>
    bool any_near(const Box& box, const Condition& holds) const;

    std::vector<Entry> entries_;      ///< by rank
    std::vector<std::uint32_t> rank_; ///< by row
    std::vector<std::uint32_t> wide_; ///< ranks of those too large for any grid, in order
    std::vector<RegionGrid> grids_;   ///< by side
};

} // namespace slod
