#pragma once

#include "cluster/particles.hpp"

namespace slod::test {

/// What the map gets wrong about a pair, over its two members: positions and velocities together, with the
/// unit of time as weight.
struct PairError {
    double even = 0, odd = 0;
    double spread = 0;  ///< of the two members about their mean, likewise
    double radius = 0;  ///< of the two members about their mean, in position
    double nearest = 0; ///< distance from a member to any other particle
};

/// Of the first two particles, as clustered and as free ones.
PairError compare_pairs(const ParticleSet& mapped, const ParticleSet& free);

} // namespace slod::test
