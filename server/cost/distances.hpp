#pragma once

#include <type_traits>

#include "cluster/particles.hpp"
#include "cost/metrics.hpp"

namespace slod::cost {

/// A cloud with what is asked of it again and again.
struct Cloud {
    explicit Cloud(ParticleSet set);

    ParticleSet particles;
    Points x, v;
};

/// How far two clouds are from each other as wholes.
struct Distances {
    double position = 0; ///< sliced Wasserstein distance, scene length
    double velocity = 0; ///< likewise, scene length / time
    double coarse = 0;   ///< of densities in cubes of a quarter of `radius`
    double fine = 0;     ///< and of a sixteenth

    double largest() const;
    Distances& operator+=(const Distances& other);
};
Distances operator/(const Distances& distances, double divisor);
Distances distances(const Cloud& a, const Cloud& b, double radius);

/// The distances at which unclustered runs of other seeds are from the reference: means.
struct Floor : Distances {
    double rms_radius = 0;  ///< of the reference, scene length
    bool resampled = false; ///< the scene has no random numbers: bootstrap samples stand in for other seeds
};

/// Calls visit(name, number) for all that it holds.
template <class SomeFloor, class Visitor>
void for_each_number(SomeFloor& floor,
                     Visitor&& visit) requires std::is_same_v<std::remove_const_t<SomeFloor>, Floor>
{
    visit("position", floor.position);
    visit("velocity", floor.velocity);
    visit("density_coarse", floor.coarse);
    visit("density_fine", floor.fine);
    visit("rms_radius", floor.rms_radius);
    visit("resampled", floor.resampled);
}

/// Each in units of the floor. 1: as another seed; below 2 good, above 3 visible.
Distances in_floors(const Distances& apart, const Distances& floor);

/// As many particles, drawn with replacement: a bootstrap sample.
ParticleSet resample(const ParticleSet& particles, std::uint32_t draw);

} // namespace slod::cost
