#pragma once

#include "cluster/particles.hpp"
#include "sim/settings.hpp"

namespace slod::test {

/// Particles that attract each other, after `frames` steps of kick, drift, kick in double, pair by pair: the
/// oracle for unclustered runs. G is 1, and a pair of kinds is softened by the mean of both squares.
ParticleSet leapfrog(ParticleSet particles, const SimulationSettings& settings, int frames);

/// Largest distance between particles of two sets ordered alike.
double largest_distance(const ParticleSet& a, const ParticleSet& b);

} // namespace slod::test
