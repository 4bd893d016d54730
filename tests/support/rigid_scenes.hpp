#pragma once

#include <string>

#include "sim/simulation.hpp"
#include "support/small_scenes.hpp"

namespace slod::test {

/// The paper to the letter: quiet_settings() in rigid motion, velocities compared at rest, and nothing that
/// moves particles but themselves.
SimulationSettings rigid_settings(double max_cluster_size);

RegionOfInterest ball_region(const std::string& name, const Vector3d& centre, double radius,
                             double max_cluster_size);
RegionOfInterest box_region(const std::string& name, const Vector3d& centre, const Vector3d& half_extent,
                            double max_cluster_size);

/// A region without bounds: for what is selected by mass, speed or acceleration.
RegionOfInterest world_region(const std::string& name, double max_cluster_size);

const Snapshot& run(Simulation& simulation, int frames); ///< at least one; the last snapshot, with clusters

/// The region that takes what is there, by asking each in order of precedence.
RegionRow region_by_asking_all(const Simulation& simulation, const Subject& subject);

/// Clusters of the snapshot that are not in the region that asking all gives them.
std::size_t clusters_in_wrong_regions(const Simulation& simulation, const Snapshot& snapshot);

/// What the region of that name holds.
RegionLoad load_of(const Simulation& simulation, const Snapshot& snapshot, const std::string& name);

/// Particles per cluster.
inline double mean_size(const RegionLoad& load)
{
    return double(load.particles) / double(load.clusters);
}

/// Root mean square distance of particles in two sets of the same ids, which are ordered by them.
double rms_distance(const ParticleSet& a, const ParticleSet& b);

/// Everything that has no pairs, gravity, drag and wind, in clusters of at most `max_cluster_size` and cells
/// of side 1024.
SimulationSettings windy(double max_cluster_size);

} // namespace slod::test
