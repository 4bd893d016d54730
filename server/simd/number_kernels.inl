// The number kernels of one instruction set; see kernel_table.inl. Plain loops, which the compiler
// vectorises.

#include "core/sincos.inl"
#include "simd/number_kernels.hpp"

namespace slod::simd::SLOD_ISA {
namespace {

/// Counter and key of Philox4x32 (Salmon et al. 2011), as core/random.hpp has it.
struct Philox {
    std::uint32_t x0, x1, x2, x3, key0, key1;

    void round()
    {
        const std::uint64_t product0 = std::uint64_t{0xD2511F53} * x0;
        const std::uint64_t product1 = std::uint64_t{0xCD9E8D57} * x2;
        x0 = std::uint32_t(product1 >> 32) ^ x1 ^ key0;
        x1 = std::uint32_t(product1);
        x2 = std::uint32_t(product0 >> 32) ^ x3 ^ key1;
        x3 = std::uint32_t(product0);
        key0 += 0x9E3779B9;
        key1 += 0xBB67AE85;
    }
};

/// What between_0_and_1() makes of both words: an odd multiple of 2^-53.
double fraction(std::uint32_t high, std::uint32_t low)
{
    const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 12 | 0x3ff0000000000000;
    double number; // in [1, 2)
    __builtin_memcpy(&number, &bits, sizeof number);
    return (number - 1) + 0x1p-53;
}

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
        first[i] = fraction(state.x0, state.x1);
        second[i] = fraction(state.x2, state.x3);
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
