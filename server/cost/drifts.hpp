#pragma once

#include <limits>

#include "cluster/particles.hpp"
#include "core/vectors.hpp"
#include "sim/settings.hpp"

namespace slod::cost {

/// More particles than this have no potential energy: the sum goes over all pairs.
inline constexpr std::size_t most_energetic = 200'000;

/// Sums over all particles, in scene units, angular momentum and second moment about the origin.
struct Totals {
    double mass = 0;
    Vector3d momentum{0, 0, 0}, angular_momentum{0, 0, 0};
    double second_moment = 0; ///< sum of m r^2
    double kinetic_energy = 0;
    double potential_energy = 0; ///< of all pairs; NaN of more than most_energetic particles
};

/// O(N^2), in parallel.
Totals totals(const ParticleSet& particles, const SimulationSettings& settings);

/// Whether nothing but the particles' own gravity acts, so that all three below are conserved.
bool is_isolated(const SimulationSettings& settings, const ParticleSet& initial);

/// What changed of that which an isolated system conserves; NaN where that is not known.
struct Drifts {
    double momentum = std::numeric_limits<double>::quiet_NaN(); ///< |change| over the largest there could be
    double angular_momentum = std::numeric_limits<double>::quiet_NaN(); ///< likewise
    double energy = std::numeric_limits<double>::quiet_NaN();           ///< change over the start's size
};
Drifts drifts(const Totals& start, const Totals& end);

} // namespace slod::cost
