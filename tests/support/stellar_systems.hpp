#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cluster/particles.hpp"
#include "support/case_rows.hpp"

// Spherical systems of stars of one mass, and how they look.
namespace slod::test {

/// A Plummer sphere in equilibrium: velocities by its distribution function. In units in which G and the mass
/// are 1 and the energy -1/4 (Henon 1971): the half-mass radius is 0.77, a crossing time 2 sqrt(2). The
/// centre is at rest at the origin. Cut at ten scale lengths, beyond which are 1.5 % of the mass. Ids from 1
/// on.
ParticleSet plummer_in_equilibrium(std::size_t count, std::uint64_t seed);

inline constexpr double crossing_time = 2.8284271247461903; ///< in those units

/// Three bodies of mass 1 that chase each other along an eight about the origin (Chenciner and Montgomery
/// 2000, Annals of Mathematics 152, 881), and the time in which each goes round it. Ids from 1 on.
ParticleSet figure_eight();

inline constexpr double figure_eight_turn = 6.32591398;

/// How a system looks at one moment.
struct SystemMeasures {
    double r10 = 0, r50 = 0,
           r90 = 0;          ///< radii about the densest place that hold such shares of the particles
    double energy = 0;       ///< kinetic and potential, for G = 1
    double virial_ratio = 0; ///< 2 K / |W|
    Vector3d momentum{0, 0, 0};
};

/// O(particles^2), of which all threads of the calling team share.
SystemMeasures measure_system(std::span<const Particle> particles, double softening);

/// The measures of a run, at the times given.
struct SystemHistory {
    std::string name;
    std::vector<double> times;
    std::vector<SystemMeasures> looks; ///< the first one is the start

    /// Largest |measure / that of the start - 1|.
    double largest_change(double SystemMeasures::*measure) const;
    double change_at_the_end(double SystemMeasures::*measure) const;
};

/// Pictures of r10, r50, r90 and of the energy's error against time.
void report_history(const std::string& title, std::span<const SystemHistory> histories);

} // namespace slod::test
