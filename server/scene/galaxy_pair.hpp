#pragma once

#include "cluster/particles.hpp"
#include "scene/initial_settings.hpp"

namespace slod {

/// Two galaxies as one set, on the parabolic orbit that point masses in their centres would have: `first` at
/// negative x and `second` at positive x, `separation` apart, approaching, with their orbital angular
/// momentum along z. Wherever the galaxies were given and however they moved, their common centre of mass
/// rests at the origin. The second is tilted about the x axis and its ids follow the first's. Both must have
/// mass, and separation >= pericentre, separation > 0; `gravitational_constant` in scene units.
ParticleSet on_parabolic_orbit(ParticleSet first, ParticleSet second, const EncounterSettings& encounter,
                               double gravitational_constant);

} // namespace slod
