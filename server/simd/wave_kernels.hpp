#pragma once

#include <cstddef>

// Plain data only, as in gravity_kernels.hpp.
namespace slod::simd {

/// Places come in multiples of this many.
inline constexpr std::size_t wave_width = 8;

/// Waves velocity cos 2 pi (number . x + shift + phase), one array entry for each.
struct Waves {
    std::size_t count;           ///< even
    const double* number[3];     ///< 1 / length
    const double* velocity[3];   ///< length / time
    const double *shift, *phase; ///< turns; the first is of the time
};

/// Where waves are summed up: places, and the sums and their derivatives by place, which are written.
struct WavePlaces {
    std::size_t padded_count; ///< a multiple of wave_width
    const double* x[3];       ///< length
    double* value[3];         ///< length / time
    double* gradient[3][3];   ///< d value_i / d x_j
};

/// Sums of waves. Those of even place are summed up by themselves, and so are the others: all processors
/// compute the same bits.
struct WaveKernels {
    void (*sum_up)(const Waves&, const WavePlaces&);

    /// At one place alone; the same bits.
    void (*sum_up_at)(const Waves&, const double (&x)[3], double (&value)[3], double (&gradient)[3][3]);
};

} // namespace slod::simd
