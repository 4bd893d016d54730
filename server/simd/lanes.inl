#pragma once

// Registers of the instruction set that the including file names, as the compiler's vector types.

#include <cstddef>

namespace slod::simd::SLOD_ISA {
namespace {

template <class Real>
struct Register {
    typedef Real Lanes __attribute__((vector_size(register_bytes)));
};

/// One register: a number for each of lane_count targets or places.
template <class Real>
using Lanes = typename Register<Real>::Lanes;

template <class Real>
constexpr std::size_t lane_count = register_bytes / sizeof(Real);

template <class Real>
Lanes<Real> load(const Real* from)
{
    Lanes<Real> lanes;
    __builtin_memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

template <class Real>
void store(Real* to, const Lanes<Real>& lanes)
{
    __builtin_memcpy(to, &lanes, sizeof lanes);
}

template <class Real>
void add_to(Real* to, const Lanes<Real>& lanes)
{
    store(to, load(to) + lanes);
}

} // namespace
} // namespace slod::simd::SLOD_ISA
