#pragma once

#include <functional>
#include <vector>

#include "core/vectors.hpp"
#include "scene/galaxy_disc_field.hpp"
#include "scene/galaxy_disc_layers.hpp"
#include "scene/galaxy_disc_orbits.hpp"
#include "scene/quiet_numbers.hpp"

namespace slod {

/// Where a particle of a model is and how it moves, G = 1.
struct PhasePoint {
    Vector3d position;
    Vector3d velocity;
};

/// An exponential sech^2 disc about the z axis, turning from x to y, in equilibrium with itself and with
/// spheres about its centre: in the plane, across it, and between both. G = 1.
class DiscModel {
public:
    /// As of DiscField and DiscOrbits.
    DiscModel(const DiscShape& shape, double softening, double toomre_q,
              const std::function<double(double)>& spheroid_potential);
    DiscModel(const DiscModel&) = delete; // its parts refer to each other
    DiscModel& operator=(const DiscModel&) = delete;

    /// The star that belongs to these random numbers. Its speed is below that of escape.
    PhasePoint star(const QuietNumbers::Point& random) const;

    double circular_speed(double radius) const { return orbits_.circular_speed(radius); }

private:
    /// A star's vertical motion relative to that of the stars about it.
    struct Swing {
        double height;
        double velocity;
    };
    Swing swing(double radius, double guiding_radius) const;

    MassProfile profile_;
    DiscField field_;
    DiscOrbits orbits_;
    DiscLayers layers_;
    std::vector<Swing> rms_swing_; ///< by radius of the field
};

} // namespace slod
