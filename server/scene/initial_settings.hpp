#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/settings.hpp"

namespace slod {

/// Where a scene's first particles come from.
enum class InitialModel : std::uint8_t {
    None,       ///< nowhere: emitters will bring them
    Gadget2,    ///< a GADGET-2 file, SnapFormat 1 (Springel 2005)
    Galaxy,     ///< one disc galaxy in equilibrium
    GalaxyPair, ///< two of them on a parabolic encounter
};

constexpr std::array<std::string_view, 4> names(InitialModel)
{
    return {"none", "gadget2", "galaxy", "galaxy_pair"};
}

struct InitialSettings {
    InitialModel model = InitialModel::None;
    std::string file; ///< of Gadget2; absolute, or in the environment's SLOD_DATA_DIR
    InitialModel fallback = InitialModel::None; ///< when the file is not there; None: that is an error
};

/// An exponential disc with a Hernquist (1990) bulge and halo that fade to nothing, all live particles.
/// Lengths and masses in scene units. A pair is two of these. The defaults are a galaxy like the Milky Way in
/// kpc and 10^10 solar masses, which 10,000 particles can hold: a halo of no more than the disc needs.
struct GalaxySettings {
    std::uint32_t particles = 10'000; ///< of one galaxy, all components together
    double disc_share = 0.6;          ///< of the particles
    double bulge_share = 0.06;        ///< of the particles; the halo has the rest
    double disc_mass = 4;
    double disc_scale_length = 3;
    double disc_scale_height = 0.55; ///< of a sech^2 profile
    double toomre_q = 1.3;           ///< at two and a half scale lengths
    double bulge_mass = 1;
    double bulge_scale_length = 0.6;
    double halo_mass = 12;
    double halo_scale_length = 10;
    double halo_cutoff = 3; ///< in halo scale lengths; the bulge ends there too
};

/// The encounter of a pair: parabolic relative orbit of the two centres.
struct EncounterSettings {
    double separation = 60; ///< of the centres at the start
    double pericentre = 8;
    double inclination_deg = 30; ///< of the second disc against the orbital plane; the first lies in it
};

template <class Visitor>
void for_each_field(InitialSettings& initial, Visitor&& visit)
{
    visit(Field{"model", "", "Where the first particles come from."}, initial.model);
    visit(
        Field{"file", "", "File of the gadget2 model, absolute or in SLOD_DATA_DIR; --input names another."},
        initial.file);
    visit(Field{"fallback", "", "Model to use when the file is not found; none makes that an error."},
          initial.fallback);
}

template <class Visitor>
void for_each_field(GalaxySettings& galaxy, Visitor&& visit)
{
    visit(Field{"particles", "", "Particles of one galaxy, all components together.", 100, 100e6},
          galaxy.particles);
    visit(Field{"disc_share", "", "Share of the particles in the disc.", 0.01, 1}, galaxy.disc_share);
    visit(Field{"bulge_share", "", "Share of the particles in the bulge; the halo has the rest.", 0, 0.99},
          galaxy.bulge_share);
    visit(Field{"disc_mass", "mass", "Mass of the disc.", 1e-30, 1e30}, galaxy.disc_mass);
    visit(Field{"disc_scale_length", "length", "Radial scale length of the exponential disc.", 1e-30, 1e30},
          galaxy.disc_scale_length);
    visit(Field{"disc_scale_height", "length", "Scale height of the disc's sech^2 profile.", 1e-30, 1e30},
          galaxy.disc_scale_height);
    visit(Field{"toomre_q", "", "Toomre's stability parameter at 2.5 scale lengths.", 0.5, 10},
          galaxy.toomre_q);
    visit(Field{"bulge_mass", "mass", "Mass of the bulge.", 0, 1e30}, galaxy.bulge_mass);
    visit(Field{"bulge_scale_length", "length", "Scale length of the bulge (Hernquist 1990).", 1e-30, 1e30},
          galaxy.bulge_scale_length);
    visit(Field{"halo_mass", "mass", "Mass of the halo inside its cut-off.", 0, 1e30}, galaxy.halo_mass);
    visit(Field{"halo_scale_length", "length", "Scale length of the halo (Hernquist 1990).", 1e-30, 1e30},
          galaxy.halo_scale_length);
    visit(Field{"halo_cutoff", "scale lengths", "Radius at which halo and bulge end.", 1, 1000},
          galaxy.halo_cutoff);
}

template <class Visitor>
void for_each_field(EncounterSettings& encounter, Visitor&& visit)
{
    visit(Field{"separation", "length", "Distance of the galaxies at the start.", 0, 1e30},
          encounter.separation);
    visit(Field{"pericentre", "length", "Closest distance of the centres on a parabolic orbit.", 0, 1e30},
          encounter.pericentre);
    visit(Field{"inclination", "deg", "Inclination of the second disc; the first lies in the orbital plane.",
                0, 180},
          encounter.inclination_deg);
}

} // namespace slod
