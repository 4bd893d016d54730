#pragma once

#include <cstdint>
#include <functional>

#include "cluster/particles.hpp"
#include "core/random.hpp"

/// What several test programs share.
namespace slod::test {

/// A point uniform in the ball of this radius about the origin.
Vector3d point_in_ball(Random& random, double radius);

/// `count` particles uniform in a ball about `centre`, with velocities uniform in a ball of radius `speed`.
/// Ids from 1 on, masses 1.
ParticleSet ball(std::size_t count, double radius, double speed, std::uint64_t seed,
                 const Vector3d& centre = Vector3d::Zero());

/// `count` particles at rest, uniform in the cube of side 2 `half_side` about `centre`. Ids from 1 on,
/// masses 1.
ParticleSet cube(std::size_t count, double half_side, std::uint64_t seed,
                 const Vector3d& centre = Vector3d::Zero());

/// `count` particles of a Plummer sphere with scale length 1 and mass 1 in all, cut at radius 10, with
/// isotropic velocities of the local dispersion (for G = 1). Ids from 1 on.
ParticleSet plummer_sphere(std::size_t count, std::uint64_t seed);

/// `count` particles of mass 1 in all, at rest where `place` puts them with a random sequence of each one's
/// own. Ids from 1 on.
ParticleSet cloud(std::size_t count, std::uint64_t seed, const std::function<Vector3d(Random&)>& place);

/// Places for cloud(): uniform in the unit box; and of a disc with surface density exp(-R), thickness 0.05.
Vector3d in_unit_box(Random& random);
Vector3d in_exponential_disc(Random& random);

/// `count` particles at rest in two Gaussian clumps of dispersion 0.02, one on the origin and one at (10.1,
/// 9.9, 10): their centre of mass is far from both.
ParticleSet two_clumps(std::size_t count, std::uint64_t seed);

/// A Plummer sphere of `count` particles whose masses are between 1e-6 and 1, uniform in the logarithm.
ParticleSet mass_spectrum(std::size_t count, std::uint64_t seed);

/// Masses uniform in [lowest, highest].
void give_masses(ParticleSet& particles, double lowest, double highest, std::uint64_t seed);

} // namespace slod::test
