#pragma once

#include <cstdint>
#include <vector>

#include "cluster/particles.hpp"
#include "core/vectors.hpp"

/// How far two clouds of particles are from each other as wholes: individual paths in a chaotic system are
/// not meaningful, distributions are (Boekholt and Portegies Zwart 2015). All are 0 for the same cloud,
/// and but for energy_distance() do not depend on the order of the particles; clouds may differ in number.
namespace slod::cost {

using Points = std::vector<Vector3d>;

/// Positions, or velocities, of the particles.
Points positions(const ParticleSet& particles);
Points velocities(const ParticleSet& particles);

/// Sliced Wasserstein distance of order 1: the mean over 64 directions, spread evenly over the half sphere,
/// of the area between the distribution functions along each (Bonneel et al. 2015). In the points' unit; for
/// a shift by s it is s times the mean |cosine|, 1/2. O(N log N). Infinite when just one cloud is empty.
double sliced_wasserstein(const Points& a, const Points& b);

/// Total variation, in [0, 1], between the shares of particles in the cubes of a grid.
double density_distance(const Points& a, const Points& b, double cube_side);

/// Square root of the energy distance, 2 E|x - y| - E|x - x'| - E|y - y'| (Szekely and Rizzo 2013), of at
/// most 1,500 points of each, spread evenly over their order: sees what no projection and no cube does. In
/// the root of the points' unit. O(1500^2), in parallel. Infinite when just one cloud is empty.
double energy_distance(const Points& a, const Points& b);

/// How a body's radial structure differs from a reference's: in the nine shells, each about its own mean,
/// that hold a tenth of the reference each, the means of |ln| of the ratios of the densities and of the
/// velocity dispersions. 0 without ten points in each.
struct ProfileDistances {
    double density = 0, dispersion = 0;
};
ProfileDistances profile_distances(const Points& reference_x, const Points& reference_v, const Points& x,
                                   const Points& v);

/// Root mean square extent along the shortest principal axis of the half of the points that is nearest to
/// the mean: how thick a disc is. 0 for less than four points.
double thickness(const Points& points);

/// Root mean square distance from the mean: 0 for less than two points.
double rms_radius(const Points& points);

/// Radius about the mean within which this share of the points is, in (0, 1]; 0 without points.
double lagrangian_radius(const Points& points, double share);

/// Median distance of particles of the same id; NaN when no id is in both. Both ordered by id.
double median_displacement(const ParticleSet& a, const ParticleSet& b);

} // namespace slod::cost
