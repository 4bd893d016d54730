#pragma once

#include <cstdint>
#include <span>

#include "cluster/particles.hpp"

namespace slod::test {

/// How a galaxy's disc looks, about its own centre and axis.
struct DiscMeasures {
    double r10 = 0, r50 = 0;      ///< radii in the disc's plane that hold a tenth and a half of its stars
    double thickness = 0;         ///< rms height
    double radial_dispersion = 0; ///< rms radial velocity about its mean
    double spin = 0;              ///< angular momentum about the axis, per unit mass
};

/// Unit vector along the angular momentum of the particles of `kind` about their own centre.
Vector3d disc_axis(std::span<const Particle> particles, std::uint8_t kind);

/// Measures of the particles of `kind`, all of one mass, about `axis`.
DiscMeasures measure_disc(std::span<const Particle> particles, std::uint8_t kind, const Vector3d& axis);

/// Median distance between the particles of `kind` in two sets ordered alike.
double median_distance(std::span<const Particle> a, std::span<const Particle> b, std::uint8_t kind);

/// Kinetic and potential energy of all particles by a double direct sum, each pair softened by
/// `softening`, on all threads of the calling team.
double total_energy(std::span<const Particle> particles, double gravitational_constant, double softening);

} // namespace slod::test
