#pragma once

#include <vector>

#include "scene/galaxy_disc_field.hpp"
#include "scene/galaxy_quantiles.hpp"

namespace slod {

/// A star's motion in the plane of its disc, and the circular orbit of the same angular momentum.
struct OrbitInPlane {
    double azimuthal;         ///< velocity
    double radial_dispersion; ///< of the radial velocity, which is normal about 0
    double guiding_radius;
};

/// Orbits in the plane of a disc in equilibrium. Stars of one angular momentum have an exponential
/// distribution of radial energies (Shu 1969, ApJ 158, 505), whose scale goes with the guiding radius; that
/// and the number of stars are corrected (Dehnen 1999, AJ 118, 1201) until the disc has its exponential
/// surface density and a squared radial dispersion that falls alike. Unlike a distribution made of means and
/// dispersions (Hernquist 1993, ApJS 86, 389) it is at rest from the start. The forces are those on the
/// disc's layers on average. G = 1.
class DiscOrbits {
public:
    /// `toomre_q`: Toomre's (1964, ApJ 139, 1217) Q at two and a half scale lengths.
    DiscOrbits(const DiscField& field, double toomre_q);

    /// The orbit at `radius` that belongs to a normal deviate, fast ones to positive deviates.
    OrbitInPlane at(double radius, double deviate) const;

    double circular_speed(double radius) const;
    double epicyclic_frequency(double radius) const; ///< of nearly circular orbits' radial oscillation

private:
    const DiscField& field_;
    std::vector<double> angular_momentum_; ///< of circular orbits, by radius
    std::vector<double> epicycle_squared_; ///< (epicyclic frequency / twice the angular one)^2, by radius
    std::vector<double> radial_squared_;   ///< squared dispersion of the stars of a guiding radius
    std::vector<NormalQuantiles> guiding_; ///< by radius: indices of guiding radii
};

} // namespace slod
