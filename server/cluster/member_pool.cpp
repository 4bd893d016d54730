#include "cluster/member_pool.hpp"

#include <algorithm>
#include <bit>

#include "core/assert.hpp"

namespace slod {
namespace {

/// Slab sizes: 1..8, then eight to the octave: 9, 10, .. 16, 18, 20, .. 32, 36, ..
std::uint32_t size_class_of(std::uint32_t rows)
{
    if (rows <= 8)
        return rows - 1;
    const auto octave = std::uint32_t(std::bit_width(rows - 1)) - 4; // 0 for 9..16
    const std::uint32_t step = 1U << octave;
    return 8 * octave + (rows - 1) / step;
}

std::uint32_t rows_of(std::uint32_t size_class)
{
    if (size_class < 8)
        return size_class + 1;
    const std::uint32_t octave = (size_class - 8) / 8;
    return ((size_class - 8) % 8 + 9) << octave;
}

} // namespace

MemberPool::MemberPool(const Columns& columns) : columns_(columns)
{
    free_.fill(no_slab);
}

Slab MemberPool::allocate(std::uint32_t rows)
{
    SLOD_ASSERT(rows >= 1 && rows <= largest_slab);
    const std::uint32_t size_class = size_class_of(rows);
    const std::uint32_t capacity = rows_of(size_class);
    if (free_[size_class] != no_slab) {
        const Slab slab{free_[size_class], capacity};
        free_[size_class] = std::uint32_t(*ids(slab));
        return slab;
    }
    if (fresh_ / chunk_rows != (fresh_ + capacity - 1) / chunk_rows)
        fresh_ = (fresh_ / chunk_rows + 1) * chunk_rows;
    while (fresh_ + capacity > row_count_)
        add_chunk();
    const Slab slab{std::uint32_t(fresh_), capacity};
    fresh_ += capacity;
    return slab;
}

void MemberPool::retire(const Slab& slab, std::uint64_t frame)
{
    SLOD_ASSERT(slab.capacity > 0);
    retired_.push_back({slab.first, size_class_of(slab.capacity), frame});
}

void MemberPool::recycle(std::uint64_t frame)
{
    auto slab = retired_.begin();
    for (; slab != retired_.end() && slab->frame < frame; ++slab) {
        *row(id_, slab->first) = free_[slab->size_class];
        free_[slab->size_class] = slab->first;
    }
    retired_.erase(retired_.begin(), slab);
}

void MemberPool::reserve(std::uint64_t rows, std::uint64_t slabs)
{
    while (fresh_ + rows > row_count_)
        add_chunk();
    if (retired_.capacity() < retired_.size() + slabs)
        retired_.reserve(2 * (retired_.size() + slabs));
}

void MemberPool::add_chunk()
{
    SLOD_ASSERT(row_count_ + chunk_rows < no_slab);
    offset_.push_back(std::make_unique_for_overwrite<FormedOffset[]>(chunk_rows));
    id_.push_back(std::make_unique_for_overwrite<std::uint64_t[]>(chunk_rows));
    if (columns_.mass)
        mass_.push_back(std::make_unique_for_overwrite<float[]>(chunk_rows));
    if (columns_.kind)
        kind_.push_back(std::make_unique_for_overwrite<std::uint8_t[]>(chunk_rows));
    if (columns_.expiry)
        expiry_.push_back(std::make_unique_for_overwrite<std::uint32_t[]>(chunk_rows));
    row_count_ += chunk_rows;
}

} // namespace slod
