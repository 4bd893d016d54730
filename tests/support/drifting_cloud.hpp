#pragma once

#include "sim/simulation.hpp"

namespace slod::test {

/// A cloud of 6,000 particles in rigid motion that drifts as one, so that all may merge with all: the maximum
/// size alone says how many clusters there are, unless the breadth is small.
Simulation drifting_cloud(double max_cluster_size, double max_breadth = 64);

} // namespace slod::test
