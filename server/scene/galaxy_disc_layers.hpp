#pragma once

#include <vector>

#include "scene/galaxy_disc_field.hpp"
#include "scene/galaxy_quantiles.hpp"

namespace slod {

/// Vertical motions of a disc's stars in equilibrium: at each distance from the axis the distribution of
/// vertical energies that gives a sech^2 profile in the softened potential, by Abel's equation. Heights of
/// few softenings make it differ from the isothermal one. G = 1.
class DiscLayers {
public:
    explicit DiscLayers(const DiscField& field);

    /// The vertical velocity that belongs to a normal deviate, odd in it.
    double velocity(double radius, double height, double deviate) const;

    /// Of the vertical velocities of all stars at that distance from the axis.
    double dispersion(double radius) const;

private:
    const DiscField& field_;
    std::vector<std::vector<NormalQuantiles>> quantiles_; ///< by radius, by height
    std::vector<double> dispersion_;                      ///< by radius
};

} // namespace slod
