#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/vectors.hpp"

namespace slod {

/// A run of consecutive rows of the member pool, owned by one cluster.
struct Slab {
    std::uint32_t first = 0;
    std::uint32_t capacity = 0;
};

/// What every member stores of its forming.
struct FormedOffset {
    Vector3f position; ///< o, scene length
    Vector3f velocity; ///< w, scene length / time
};

/// The members of all clusters, one array per quantity, in slabs. Rows are written once, when their member
/// joins, and not again until the slab has been retired and recycled: whoever holds a cluster table of an
/// earlier frame may read its members meanwhile. Memory comes in chunks that never move.
class MemberPool {
public:
    static constexpr std::uint32_t chunk_rows = 1U << 20; ///< a slab lies within one chunk
    static constexpr std::uint32_t largest_slab = chunk_rows;

    /// Columns that not every scene needs.
    struct Columns {
        bool mass = false, kind = false, expiry = false;
    };

    explicit MemberPool(const Columns& columns);

    /// A slab of at least `rows` rows (1 to largest_slab). Takes memory from the system only when
    /// reserve() did not provide enough.
    Slab allocate(std::uint32_t rows);

    /// The slab's rows may still be read by holders of frame `frame` and earlier.
    void retire(const Slab& slab, std::uint64_t frame);

    /// Makes all slabs available again that were retired before `frame`.
    void recycle(std::uint64_t frame);

    /// Provides room for `rows` more rows and `slabs` more retired slabs.
    void reserve(std::uint64_t rows, std::uint64_t slabs);

    FormedOffset* offsets(const Slab& slab) { return row(offset_, slab.first); }
    std::uint64_t* ids(const Slab& slab) { return row(id_, slab.first); }
    float* masses(const Slab& slab) { return columns_.mass ? row(mass_, slab.first) : nullptr; }
    std::uint8_t* kinds(const Slab& slab) { return columns_.kind ? row(kind_, slab.first) : nullptr; }
    std::uint32_t* expiries(const Slab& slab) { return columns_.expiry ? row(expiry_, slab.first) : nullptr; }
    const FormedOffset* offsets(const Slab& slab) const { return row(offset_, slab.first); }
    const std::uint64_t* ids(const Slab& slab) const { return row(id_, slab.first); }
    const float* masses(const Slab& slab) const { return columns_.mass ? row(mass_, slab.first) : nullptr; }
    const std::uint8_t* kinds(const Slab& slab) const
    {
        return columns_.kind ? row(kind_, slab.first) : nullptr;
    }
    const std::uint32_t* expiries(const Slab& slab) const
    {
        return columns_.expiry ? row(expiry_, slab.first) : nullptr;
    }

    const Columns& columns() const { return columns_; }

private:
    template <class T>
    using Column = std::vector<std::unique_ptr<T[]>>; ///< by chunk

    template <class T>
    static T* row(const Column<T>& column, std::uint32_t index)
    {
        return column[index / chunk_rows].get() + index % chunk_rows;
    }

    struct Retired {
        std::uint32_t first;
        std::uint32_t size_class;
        std::uint64_t frame;
    };

    void add_chunk();

    /// Slabs come in sizes of at most 1/8 waste; a free slab's first id is the next free one of its size.
    static constexpr std::uint32_t size_class_count = 160;
    static constexpr std::uint32_t no_slab = 0xffff'ffff;

    Columns columns_;
    Column<FormedOffset> offset_;
    Column<std::uint64_t> id_;
    Column<float> mass_;
    Column<std::uint8_t> kind_;
    Column<std::uint32_t> expiry_;
    std::array<std::uint32_t, size_class_count> free_{};
    std::vector<Retired> retired_; ///< in order of frame
    std::uint64_t fresh_ = 0;      ///< first row never given away
    std::uint64_t row_count_ = 0;  ///< in all chunks
};

} // namespace slod
