#pragma once

#include "gravity/force_view.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// Potential energy of all pairs, sum over pairs of -G m_i m_j / (d^2 + q_i + q_j)^(1/2), in double. Bodies
/// are told apart by their place in the view: coincident ones are pairs like any other, when softened.
double potential_energy(const ForceView& view, const simd::KernelTable& kernels,
                        double gravitational_constant);

} // namespace slod
