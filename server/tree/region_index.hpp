#pragma once

#include <cstdint>
#include <vector>

#include "tree/cell_map.hpp"
#include "tree/region.hpp"

namespace slod {

/// Row of a region in the SLOD-tree; the background's is 0.
using RegionRow = std::uint16_t;
inline constexpr RegionRow background_row = 0;

/// Which region takes what is at a place: the regions in their order of precedence, and a coarse grid that
/// names those which reach into each of its cells, so that a thousand small regions cost what one does.
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
    void lay_grid();
    void spread(std::uint32_t rank);
    bool fits_grid(const Box& bounds) const;
    Cell cell_of(const Vector3d& x) const;

    /// Whether `holds(rank)` is true of any region that may reach into the box.
    template <class Condition>
    bool any_near(const Box& box, const Condition& holds) const;

    /// A region that reaches into a cell of the grid.
    struct Reach {
        Cell cell;
        std::uint32_t rank;

        friend constexpr auto operator<=>(const Reach&, const Reach&) = default;
    };

    std::vector<Entry> entries_;      ///< by rank
    std::vector<std::uint32_t> rank_; ///< by row
    std::vector<std::uint32_t> wide_; ///< ranks of those too large for the grid
    double side_ = 1;                 ///< of the grid's cells
    std::vector<Reach> reaches_;      ///< by cell, then rank
    CellMap first_reach_;             ///< by cell, row of `reaches_`
};

} // namespace slod
