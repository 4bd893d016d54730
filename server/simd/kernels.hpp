#pragma once

#include <span>
#include <string_view>

#include "simd/kernel_table.hpp"

namespace slod::simd {

/// All instruction sets this processor can run, slowest first; the first is "baseline".
std::span<const KernelTable* const> runnable_kernels();

/// The fastest this processor can run.
const KernelTable& kernels();

/// Those of "baseline", "v3" or "v4", or the fastest for "auto" and "". Null when the name is unknown or
/// this processor cannot run them.
const KernelTable* kernels(std::string_view isa);

/// The kernels of one precision, for code that is a template of it.
template <class Real>
const GravityKernels<Real>& gravity_kernels(const KernelTable& table);

template <>
inline const GravityKernels<float>& gravity_kernels(const KernelTable& table)
{
    return table.in_float;
}

template <>
inline const GravityKernels<double>& gravity_kernels(const KernelTable& table)
{
    return table.in_double;
}

} // namespace slod::simd
