// All kernels of one instruction set. Each kernels_<isa>.cpp names that and the size of its registers,
// includes this, and has its own -march.
//
// Nothing here may call an inline function of another header: the linker keeps one copy of it, and might
// keep the one built for a processor we lack.

#include "simd/gravity_kernels.inl"
#include "simd/kernel_table.hpp"
#include "simd/number_kernels.inl"
#include "simd/wave_kernels.inl"

namespace slod::simd::SLOD_ISA {

extern const KernelTable table;
constinit const KernelTable table = {name, gravity_kernels<float>, gravity_kernels<double>, number_kernels,
                                     wave_kernels};

} // namespace slod::simd::SLOD_ISA
