#pragma once

#include "gravity/force_view.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// Accelerations of all clusters, and tidal tensors where the table has them, by summing all pairs:
/// G m_j d / (d^2 + q_i + q_j)^(3/2). Positions go to the kernels relative to a block of neighbouring
/// targets and in units of the system's extent and mass, so that scenes far from the origin and in any
/// units lose nothing. Written to the cluster table.
void sum_directly(const ForceView& view, const simd::KernelTable& kernels, Precision precision,
                  double gravitational_constant, ClusterTable& clusters);

/// Potential energy of all pairs, sum over pairs of -G m_i m_j / (d^2 + q_i + q_j)^(1/2), in double.
double potential_energy(const ForceView& view, const simd::KernelTable& kernels,
                        double gravitational_constant);

} // namespace slod
