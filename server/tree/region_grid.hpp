#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "tree/box.hpp"
#include "tree/cell_map.hpp"

namespace slod {

/// A coarse grid that names, for each of its cells, those of some boxes that reach into it. A box is known by
/// its rank.
class RegionGrid {
public:
    /// `side` of the cells: above 0, scene length.
    explicit RegionGrid(double side) : side_(side) {}

    double side() const { return side_; }

    /// Whether the box spans so few cells that it is worth looking into each.
    bool fits(const Box& box) const;

    /// Adds a box that fits, in order of rank; finish() after the last one.
    void add(const Box& box, std::uint32_t rank);
    void finish();

    /// Ranks of the boxes that may hold `x`, in order.
    std::span<const std::uint32_t> at(const Vector3d& x) const { return in(cell_of(x)); }

    /// Whether `holds(rank)` is true of any that may meet the box.
    template <class Condition>
    bool any_near(const Box& box, const Condition& holds) const
    {
        if (!fits(box))
            return std::any_of(all_.begin(), all_.end(), holds);
        const Cell first = cell_of(box.lower), last = cell_of(box.upper);
        for (std::int32_t x = first.x; x <= last.x; ++x)
            for (std::int32_t y = first.y; y <= last.y; ++y)
                for (std::int32_t z = first.z; z <= last.z; ++z)
                    if (const auto ranks = in({x, y, z}); std::any_of(ranks.begin(), ranks.end(), holds))
                        return true;
        return false;
    }

private:
    /// A box that reaches into a cell.
    struct Reach {
        Cell cell;
        std::uint32_t rank;

        friend constexpr auto operator<=>(const Reach&, const Reach&) = default;
    };

    Cell cell_of(const Vector3d& x) const;
    std::span<const std::uint32_t> in(const Cell& cell) const;

    double side_;
    std::vector<std::uint32_t> all_;       ///< ranks
    std::vector<Reach> reaches_;           ///< until finish()
    std::vector<std::uint32_t> ranks_;     ///< by cell, then rank
    std::vector<std::uint32_t> run_begin_; ///< by run of one cell, one more than there are: row of `ranks_`
    CellMapOf<RunId> runs_;
};

} // namespace slod
