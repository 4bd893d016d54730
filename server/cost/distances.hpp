#pragma once

#include <array>
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

/// How far a cloud is from a reference as a whole.
struct Distances {
    double position = 0;   ///< sliced Wasserstein distance, scene length
    double velocity = 0;   ///< likewise, scene length / time
    double energy = 0;     ///< energy distance of positions, square root of scene length
    double coarse = 0;     ///< of densities in cubes of a quarter of `radius`
    double fine = 0;       ///< and of a sixteenth
    double profile = 0;    ///< of the radial density: of its logarithm
    double dispersion = 0; ///< of the velocity dispersion, likewise

    /// Of all but the two profiles, which mean something where there is one body.
    double largest() const;
    Distances& operator+=(const Distances& other);
};

/// The only list of them.
struct DistanceMember {
    const char* name;
    double Distances::*value;
};
inline constexpr std::array<DistanceMember, 7> distance_members{{
    {"position", &Distances::position},
    {"velocity", &Distances::velocity},
    {"energy", &Distances::energy},
    {"density_coarse", &Distances::coarse},
    {"density_fine", &Distances::fine},
    {"density_profile", &Distances::profile},
    {"dispersion_profile", &Distances::dispersion},
}};

Distances operator/(const Distances& distances, double divisor);

/// `radius` is the length that cubes are in proportion to.
Distances distances(const Cloud& reference, const Cloud& other, double radius);

/// The distances at which unclustered runs of other seeds are from the scene's own: means.
struct Floor : Distances {
    double rms_radius = 0;  ///< of the scene's own, scene length
    bool resampled = false; ///< the scene has no random numbers: bootstrap samples stand in for other seeds
};

/// Calls visit(name, number) for all that it holds.
template <class SomeFloor, class Visitor>
void for_each_number(SomeFloor& floor,
                     Visitor&& visit) requires std::is_same_v<std::remove_const_t<SomeFloor>, Floor>
{
    for (const DistanceMember& member : distance_members)
        visit(member.name, floor.*member.value);
    visit("rms_radius", floor.rms_radius);
    visit("resampled", floor.resampled);
}

/// Each in units of the floor. 1: as another seed; below 2 good, above 3 visible.
Distances in_floors(const Distances& apart, const Distances& floor);

/// As many particles, drawn with replacement: a bootstrap sample.
ParticleSet resample(const ParticleSet& particles, std::uint32_t draw);

} // namespace slod::cost
