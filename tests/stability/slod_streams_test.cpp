#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/rigid_scenes.hpp"

// Rings that shear, streams from emitters, and light particles among heavy ones.
namespace slod::test {
namespace {

/// Light particles on circles of radius 0.9 to 1.1 about a heavy one that turn once in 2 pi units of time.
ParticleSet ring(std::size_t count)
{
    ParticleSet particles(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
        Random random(20, 6, i);
        Particle& particle = particles[i];
        particle.position.setZero();
        particle.velocity.setZero();
        particle.id = i + 1;
        particle.mass = i == 0 ? 1 : 1e-9F;
        if (i == 0)
            continue;
        const double radius = 0.9 + 0.2 * random.uniform();
        const auto [x, y] = random.point_in_disc();
        const double length = std::hypot(x, y);
        particle.position = Vector3d(x, y, 0) * (radius / length);
        // The softening of 0.05 weakens the pull.
        const double speed = radius / std::pow(radius * radius + 0.0025, 0.75);
        particle.velocity = Vector3d(-y, x, 0) * (speed / length);
    }
    return particles;
}

/// Rms distance of the ring's particles from the circle of their mean radius, after ten turns.
double width_after_ten_turns(const RegionSettings& background)
{
    SimulationSettings settings = rigid_settings(1);
    settings.background = background;
    settings.time.step = 2 * 3.14159265358979 / 128;
    settings.gravity.emplace();
    settings.gravity->size_softening = 0;
    settings.gravity->direct_below = 100'000;
    Simulation simulation(settings, ring(600), {});
    run(simulation, 1280);
    double mean = 0, squares = 0;
    for (const Particle& particle : simulation.particles()) {
        if (particle.mass == 1)
            continue;
        const double radius = particle.position.norm();
        mean += radius / 600;
        squares += radius * radius / 600;
    }
    return std::sqrt(squares - mean * mean);
}

// The members of a rigid cluster keep the velocities relative to it with which it was formed. While it turns
// with the ring they are of no consequence, and what counts is that it is narrower than the ring; once it is
// split they are, and outdated: the drift of members is for straight flight, not for orbits.
TEST(SlodStability, S20_AShearedRingKeepsItsWidthInClustersNarrowerThanItThatAreNotSplit)
{
    RegionSettings region;
    region.max_cluster_size = 1;
    const double exact = width_after_ten_turns(region);
    region.max_cluster_size = 64;
    region.bin_by = BinBy::Mass; // the heavy one stays by itself
    region.bin_floor = 1e-3;
    region.speed_ratio = 1.01;
    region.angle_deg = 1;
    region.max_breadth = 0.2;
    EXPECT_LE(width_after_ten_turns(region), 1.1 * exact);
    region.drift_limit = 0.02;
    EXPECT_GT(width_after_ten_turns(region), 1.1 * exact);
    region.drift_limit = std::numeric_limits<double>::infinity();
    region.max_breadth = 0.5;
    EXPECT_GT(width_after_ten_turns(region), 1.1 * exact);
}

/// Rms distance of free flight from where a sheared cloud's clusters take its particles in a unit of time.
double error_in_a_shear(double drift_limit)
{
    ParticleSet particles = ball(2000, 2, 0, 5);
    for (Particle& particle : particles)
        particle.velocity = {particle.position.y(), 0, 0};
    SimulationSettings settings = rigid_settings(64);
    settings.background.drift_limit = drift_limit;
    Simulation simulation(settings, particles, {});
    run(simulation, 64);
    ParticleSet exact = particles;
    for (Particle& particle : exact)
        particle.position += particle.velocity;
    return rms_distance(simulation.particles(), exact);
}

// Merged and split again and again, a particle is off by no more than the drift of each of the clusters it
// was in: here that comes to a seventh of what shear makes of clusters that stay.
TEST(SlodStability, S20_InStraightFlightWhatDriftsApartIsSplit)
{
    EXPECT_LE(error_in_a_shear(0.01), 0.25 * error_in_a_shear(1e9));
}

} // namespace
} // namespace slod::test
