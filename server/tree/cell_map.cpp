#include "tree/cell_map.hpp"

#include <bit>
#include <utility>

#include "core/assert.hpp"

namespace slod {

template <class Value>
std::size_t CellMapOf<Value>::home(const Cell& cell) const
{
    // Multiplicative mixing (Knuth 1998, vol. 3, 6.4) of the coordinates.
    std::uint64_t hash =
        (std::uint32_t(cell.x) ^ std::uint64_t(std::uint32_t(cell.bin)) << 32) * 0x9E3779B97F4A7C15ULL;
    hash = (hash ^ (hash >> 29) ^ std::uint32_t(cell.y)) * 0xBF58476D1CE4E5B9ULL;
    hash = (hash ^ (hash >> 32) ^ std::uint32_t(cell.z)) * 0x94D049BB133111EBULL;
    return std::size_t(hash ^ (hash >> 31)) & mask();
}

template <class Value>
std::size_t CellMapOf<Value>::position_of(const Cell& cell) const
{
    std::size_t position = home(cell);
    while (slots_[position].value.valid() && slots_[position].cell != cell)
        position = (position + 1) & mask();
    return position;
}

template <class Value>
Value CellMapOf<Value>::find(const Cell& cell) const
{
    return slots_[position_of(cell)].value;
}

template <class Value>
std::size_t CellMapOf<Value>::probes(const Cell& cell) const
{
    return 1 + ((position_of(cell) - home(cell)) & mask());
}

template <class Value>
void CellMapOf<Value>::insert(const Cell& cell, Value value)
{
    SLOD_ASSERT(value.valid() && !find(cell).valid());
    reserve(size_ + 1);
    slots_[position_of(cell)] = {cell, value};
    ++size_;
}

template <class Value>
void CellMapOf<Value>::erase(const Cell& cell)
{
    std::size_t hole = position_of(cell);
    SLOD_ASSERT(slots_[hole].value.valid());
    --size_;
    // Close the gap: whatever probed past the hole moves into it.
    for (std::size_t next = (hole + 1) & mask(); slots_[next].value.valid(); next = (next + 1) & mask()) {
        const std::size_t displacement = (next - home(slots_[next].cell)) & mask();
        if (displacement >= ((next - hole) & mask())) {
            slots_[hole] = slots_[next];
            hole = next;
        }
    }
    slots_[hole] = {};
}

template <class Value>
void CellMapOf<Value>::reserve(std::size_t cells)
{
    if (2 * cells > slots_.size())
        grow(std::bit_ceil(2 * cells));
}

template <class Value>
void CellMapOf<Value>::grow(std::size_t slots)
{
    std::vector<Slot> old(slots);
    std::swap(old, slots_);
    for (const Slot& slot : old)
        if (slot.value.valid())
            slots_[position_of(slot.cell)] = slot;
}

template class CellMapOf<NodeId>;
template class CellMapOf<RunId>;

} // namespace slod
