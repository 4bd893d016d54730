#pragma once

#include "simd/gravity_kernels.hpp"
#include "simd/number_kernels.hpp"
#include "simd/wave_kernels.hpp"

namespace slod::simd {

/// One instruction set's kernels.
struct KernelTable {
    const char* name; ///< the x86-64 level: "baseline", "v3" or "v4"
    GravityKernels<float> in_float;
    GravityKernels<double> in_double;
    NumberKernels numbers;
    WaveKernels waves;
};

} // namespace slod::simd
