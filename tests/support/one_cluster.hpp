#pragma once

#include <iosfwd>
#include <string>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"

namespace slod::test {

/// One particle by itself, or 64 that share one cluster: who takes a cluster's mass for that of a particle
/// moves it 64 times as fast, or as slow.
struct Crowd {
    std::string name;
    std::size_t particles = 1;
    Motion motion = Motion::Flow;
};

void PrintTo(const Crowd& crowd, std::ostream* out);
std::string name_of(const testing::TestParamInfo<Crowd>& info);

/// One particle, and clusters of 64 in `flow` and in `rigid`.
std::vector<Crowd> crowds();

/// quiet_settings() in which so many share a cluster.
SimulationSettings settings_for(const Crowd& crowd);

/// `count` particles of mass `mass` within `radius` of the place, and of the velocity, which are their means.
ParticleSet about(std::size_t count, const Vector3d& position, const Vector3d& velocity, double radius,
                  float mass = 1);

/// The only cluster of a simulation; throws where there are more or none.
struct Centre {
    Vector3d position{0, 0, 0}, velocity{0, 0, 0};
};
Centre only_centre(Simulation& simulation);

} // namespace slod::test
