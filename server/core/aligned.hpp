#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace slod {

/// Bytes of the widest vector register and of a cache line.
inline constexpr std::size_t simd_alignment = 64;

template <class T>
struct AlignedAllocator {
    using value_type = T;

    AlignedAllocator() = default;
    template <class U>
    constexpr AlignedAllocator(const AlignedAllocator<U>&)
    {}

    T* allocate(std::size_t count)
    {
        return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{simd_alignment}));
    }
    void deallocate(T* memory, std::size_t) { ::operator delete (memory, std::align_val_t{simd_alignment}); }

    friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

/// A vector whose first element lies on a cache line.
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

} // namespace slod
