#pragma once

#include <span>

#include "cluster/conserved.hpp"
#include "cluster/particles.hpp"

namespace slod::test {

/// The conserved quantities of particles, one by one: the oracle for those that clusters know of themselves.
/// Summed in long double, so that the sums add no rounding to that of their terms.
ConservedQuantities totals(std::span<const Particle> particles);

/// Kinetic energy and angular momentum of the motion about the common centre of mass, and what they are
/// small against: sum m |dv|^2 / 2 and sum m |dx| |dv|.
struct InternalMotion {
    double kinetic_energy = 0;
    double angular_momentum = 0;
};
InternalMotion internal_motion(std::span<const Particle> particles);

} // namespace slod::test
