#pragma once

#include <functional>
#include <vector>

#include "scene/galaxy_mass.hpp"
#include "scene/galaxy_quantiles.hpp"

namespace slod {

/// Speeds of a spheroid in equilibrium with a given potential, directions being isotropic: the distribution
/// of energies that alone gives the spheroid's density (Eddington 1916, MNRAS 76, 572; Binney and Tremaine
/// 2008, section 4.3.1), turned into quantiles of the speed at each radius.
class IsotropicSpeeds {
public:
    /// `potential(radius)` ascends with the radius; G = 1.
    IsotropicSpeeds(const SpheroidShape& spheroid, const std::function<double(double)>& potential);

    /// The speed at `radius` that belongs to a normal deviate; too slow to reach the cut-off.
    double speed(double radius, double deviate) const;

private:
    double scale_length_;
    double steps_per_s_;                     ///< table steps per unit of s = r / (r + scale_length)
    std::vector<NormalQuantiles> quantiles_; ///< by radius, from the cut-off inwards
};

} // namespace slod
