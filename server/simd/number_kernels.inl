// The number kernels of one instruction set; see kernel_table.inl. Plain loops, which the compiler
// vectorises.

#include "core/philox.inl"
#include "core/sincos.inl"
#include "simd/number_kernels.hpp"

namespace slod::simd::SLOD_ISA {
namespace {

void fill_uniforms(const RandomItems& items, std::uint32_t pair, double* __restrict first,
                   double* __restrict second)
{
    const RandomItems all = items; // which nothing written can be part of
    for (std::size_t i = 0; i < all.count; ++i) {
        const std::uint64_t item = all.first + i;
        Philox state{pair,       all.stream, std::uint32_t(item), std::uint32_t(item >> 32),
                     all.key[0], all.key[1]};
#pragma GCC unroll 10
        for (int round = 0; round < 10; ++round)
            state.round();
        first[i] = fraction_of(std::uint64_t{state.x0} << 32 | state.x1);
        second[i] = fraction_of(std::uint64_t{state.x2} << 32 | state.x3);
    }
}

void sines_and_cosines(const double* __restrict angles, std::size_t count, double* __restrict sines,
                       double* __restrict cosines)
{
    for (std::size_t i = 0; i < count; ++i) {
        const SineCosine turn = sincos_of(angles[i]);
        sines[i] = turn.sine;
        cosines[i] = turn.cosine;
    }
}

constexpr NumberKernels number_kernels = {fill_uniforms, sines_and_cosines};

} // namespace
} // namespace slod::simd::SLOD_ISA
