#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cluster/particles.hpp"
#include "core/vectors.hpp"

namespace slod::cost {

/// What the accelerations of some bodies are by Newton's law (G = 1, Plummer softening), each summed over all
/// pairs in double.
struct ExactForces {
    std::vector<std::size_t> bodies; ///< by their place among all
    std::vector<Vector3d> accelerations;
};

/// Of at most `samples` bodies, spread evenly over all. O(samples N), in parallel.
ExactForces exact_forces(const ParticleSet& bodies, double softening, std::size_t samples = 2000);

/// |a - exact| / |exact| over the sampled bodies. Bodies that feel nothing are left out.
struct ForceErrors {
    double median = 0, p90 = 0, p99 = 0, max = 0, rms = 0;
};

/// `accelerations` are those of all bodies.
ForceErrors force_errors(std::span<const Vector3d> accelerations, const ExactForces& exact);

} // namespace slod::cost
