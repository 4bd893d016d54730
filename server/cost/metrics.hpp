#pragma once

#include <cstdint>
#include <vector>

#include "cluster/particles.hpp"
#include "core/vectors.hpp"

/// How far two clouds of particles are from each other as wholes: individual paths in a chaotic system are
/// not meaningful, distributions are (Boekholt and Portegies Zwart 2015). All are 0 for the same cloud,
/// symmetric, and do not depend on the order of the particles; clouds may differ in number.
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

/// Root mean square distance from the mean: 0 for less than two points.
double rms_radius(const Points& points);

/// Radius about the mean within which this share of the points is, in (0, 1]; 0 without points.
double lagrangian_radius(const Points& points, double share);

/// Median distance of particles of the same id; NaN when no id is in both. Both ordered by id.
double median_displacement(const ParticleSet& a, const ParticleSet& b);

} // namespace slod::cost
