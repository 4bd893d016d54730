#pragma once

#include <string>

#include "sim/simulation.hpp"

namespace slod::test {

/// A jet whose particles fly on for ten units of time, 640 in each, ten in a frame: clusters of at most 16
/// are filled in two frames. The background groups them at once.
SimulationSettings stream_settings();

/// The same with a ball of radius `reach` about the emitter, in which clusters of newborns move as asked.
SimulationSettings stream_settings(double reach, ClusterVelocity velocity);

/// Mean square velocity across the jet's axis.
double transverse_variance(const ClusterStates& clusters);
double transverse_variance(const ParticleSet& particles);

/// Sum of mass times velocity of the clusters.
Vector3d momentum_of(const ClusterStates& clusters);

} // namespace slod::test
