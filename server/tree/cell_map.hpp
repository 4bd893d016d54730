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

/// What is in the occupied cells of a sparse uniform grid, by an id: open addressing with linear probing, at
/// most half full, so that a grid of any size costs only what it holds.
template <class Value>
class CellMapOf {
public:
    CellMapOf() : slots_(64) {}

    /// What is in the cell; invalid when it is not there.
    Value find(const Cell& cell) const;

    /// Slots that find() looks at for the cell.
    std::size_t probes(const Cell& cell) const;

    /// The cell must not be there yet.
    void insert(const Cell& cell, Value value);

    /// The cell must be there.
    void erase(const Cell& cell);

    std::size_t size() const { return size_; }

    /// Provides room for `cells` cells in all.
    void reserve(std::size_t cells);

    /// Calls visit(cell, value) for every cell, in no particular but always the same order.
    template <class Visitor>
    void for_each(const Visitor& visit) const
    {
        for (const Slot& slot : slots_)
            if (slot.value.valid())
                visit(slot.cell, slot.value);
    }

private:
    struct Slot {
        Cell cell;
        Value value;
    };

    std::size_t mask() const { return slots_.size() - 1; }
    std::size_t home(const Cell& cell) const;
    std::size_t position_of(const Cell& cell) const; ///< of the cell, or of the free slot it would take
    void grow(std::size_t slots);

    std::vector<Slot> slots_; ///< a power of two of them
    std::size_t size_ = 0;
};

/// The roots of the cells' k-d trees.
using CellMap = CellMapOf<NodeId>;

} // namespace slod
