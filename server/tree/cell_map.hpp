#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ids.hpp"

namespace slod {

/// A cell of an unbounded uniform grid, by integer coordinates, and the bin of a physical quantity above it.
struct Cell {
    std::int32_t x = 0, y = 0, z = 0;
    std::int32_t bin = 0;

    friend constexpr auto operator<=>(const Cell&, const Cell&) = default;
};

/// The occupied cells of a sparse uniform grid and the root of each one's k-d tree: open addressing with
/// linear probing, at most half full, so that a region of any size costs only what it holds.
class CellMap {
public:
    CellMap() : slots_(64) {}

    /// Root of the cell's k-d tree; invalid when the cell is not there.
    NodeId find(const Cell& cell) const;

    /// The cell must not be there yet.
    void insert(const Cell& cell, NodeId root);

    /// The cell must be there.
    void erase(const Cell& cell);

    std::size_t size() const { return size_; }

    /// Provides room for `cells` cells in all.
    void reserve(std::size_t cells);

    /// Calls visit(cell, root) for every cell, in no particular but always the same order.
    template <class Visitor>
    void for_each(const Visitor& visit) const
    {
        for (const Slot& slot : slots_)
            if (slot.root.valid())
                visit(slot.cell, slot.root);
    }

private:
    struct Slot {
        Cell cell;
        NodeId root;
    };

    std::size_t mask() const { return slots_.size() - 1; }
    std::size_t home(const Cell& cell) const;
    std::size_t position_of(const Cell& cell) const; ///< of the cell, or of the free slot it would take
    void grow(std::size_t slots);

    std::vector<Slot> slots_; ///< a power of two of them
    std::size_t size_ = 0;
};

} // namespace slod
