#pragma once

#include <cstdint>

#include "cluster/particles.hpp"
#include "scene/initial_settings.hpp"

namespace slod {

/// The kind of a component's particles: its row in the scene, and what that row says of the softening.
struct GalaxyKind {
    std::uint8_t index = 0;
    double softening = 0; ///< scene length; a pair is softened by (e_i^2 + e_j^2) / 2
};

struct GalaxyKinds {
    GalaxyKind disc, bulge, halo;
};

/// A galaxy in equilibrium under its own softened gravity, centred on the origin, at rest, its disc in the
/// plane z = 0 and turning from x to y. Exponential sech^2 disc by the epicycle approximation, bulge and halo
/// by isotropic distribution functions in the spherically averaged potential. All velocities are bound.
/// Ids are 0 to n-1: first the disc, then the bulge, then the halo. A component without mass has no
/// particles; what its share says goes to the disc. `gravitational_constant` in scene units, > 0.
ParticleSet make_galaxy(const GalaxySettings& settings, const GalaxyKinds& kinds,
                        double gravitational_constant, std::uint64_t seed);

} // namespace slod
