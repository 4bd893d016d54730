#pragma once

#include <cstddef>
#include <cstdint>

// Plain data only, as in gravity_kernels.hpp.
namespace slod::simd {

/// Whose random numbers are asked for: those of Random(key, stream, item) for so many items from `first` on.
struct RandomItems {
    std::uint32_t key[2]; ///< lower and upper half of the seed
    std::uint32_t stream;
    std::uint64_t first;
    std::size_t count;
};

/// Numbers for many at once, with the bits of the functions of core that give one. Arrays need no alignment,
/// and those written overlap no other.
struct NumberKernels {
    /// Writes numbers 2 pair and 2 pair + 1 of each item, in (0, 1), as Random::uniform() gives them.
    void (*fill_uniforms)(const RandomItems& items, std::uint32_t pair, double* first, double* second);

    /// As portable_sincos().
    void (*sines_and_cosines)(const double* angles, std::size_t count, double* sines, double* cosines);
};

} // namespace slod::simd
