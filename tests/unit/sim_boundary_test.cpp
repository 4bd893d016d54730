#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/small_scenes.hpp"

// Scenes at the edge of what makes sense: nothing, one thing, everything in one place, nothing that weighs.
namespace slod::test {

namespace {

constexpr int frame_count = 40;

std::string name_of(const testing::TestParamInfo<SmallScene>& info)
{
    return info.param.name;
}

/// Self-gravity in clusters of `max_cluster_size`, with cells of side 1024 whose middle is at `middle`.
SimulationSettings attracting(double max_cluster_size)
{
    SimulationSettings settings = quiet_settings();
    settings.gravity.emplace();
    settings.background.max_cluster_size = max_cluster_size;
    settings.background.max_breadth = 1024;
    return settings;
}

const Vector3d middle(512, 512, 512);

/// The particles after frame_count frames, which must leave the simulation sound.
ParticleSet particles_after(const SimulationSettings& settings, const ParticleSet& initial)
{
    Simulation simulation(settings, initial, {});
    for (int frame = 0; frame < frame_count; ++frame)
        simulation.step({});
    EXPECT_EQ(simulation.problems(), Problems{});
    const ParticleSet particles = simulation.particles();
    EXPECT_EQ(particles.size(), initial.size());
    for (const Particle& particle : particles)
        EXPECT_TRUE(particle.position.allFinite() && particle.velocity.allFinite())
            << "particle " << particle.id;
    return particles;
}

/// Expects particles to have moved straight on, to `tolerance`.
void expect_straight_on(const ParticleSet& initial, const ParticleSet& particles, double time,
                        double tolerance)
{
    ASSERT_EQ(initial.size(), particles.size());
    for (std::size_t i = 0; i < initial.size(); ++i) {
        const Vector3d there = initial[i].position + time * initial[i].velocity;
        expect_at_most("largest distance from the straight line", (particles[i].position - there).norm(),
                       tolerance);
        expect_at_most("largest change of a velocity", (particles[i].velocity - initial[i].velocity).norm(),
                       tolerance);
    }
}

class Boundary : public testing::TestWithParam<SmallScene> {};

TEST_P(Boundary, G26_AnEmptyWorldStaysEmpty)
{
    SimulationSettings settings = GetParam().settings;
    settings.emitters.clear();
    Simulation simulation(settings, {}, {});
    for (int frame = 0; frame < frame_count; ++frame) {
        const Snapshot& snapshot = simulation.step({.clusters = true, .conserved = true});
        const FrameCounts& counts = snapshot.counts;
        expect_at_most("particles, clusters and interactions",
                       double(counts.particles + counts.clusters + counts.interactions), 0);
        EXPECT_EQ(snapshot.clusters.size(), 0U);
        EXPECT_EQ(snapshot.conserved.mass, 0);
    }
    EXPECT_TRUE(simulation.particles().empty());
    EXPECT_EQ(simulation.problems(), Problems{});
}

// Coordinates, velocity and step are such that no step rounds.
TEST_P(Boundary, G26_AParticleAloneMovesStraightOn)
{
    SimulationSettings settings = GetParam().settings;
    settings.emitters.clear();
    settings.uniform_gravity.reset();
    settings.linear_drag.reset();
    settings.uniform_wind.reset();
    settings.quadratic_drag.reset();
    settings.fields = {};
    settings.brownian.reset();
    settings.speed_limit.reset();
    settings.sinks.clear();
    const ParticleSet initial{{{-0.5, 3, 0.25}, {8, -4, 0}, 7, 1.5F}};
    expect_straight_on(initial, particles_after(settings, initial), frame_count * settings.time.step, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Boundary, testing::ValuesIn(small_scenes()), name_of);

/// Softening, precision and cluster size.
struct Coincidence {
    double softening;
    Precision precision;
    double max_cluster_size;

    friend std::ostream& operator<<(std::ostream& out, const Coincidence& c)
    {
        return out << "softening " << c.softening
                   << (c.precision == Precision::Mixed ? ", mixed" : ", double") << ", clusters of "
                   << c.max_cluster_size;
    }
};

class CoincidentParticles : public testing::TestWithParam<Coincidence> {
protected:
    SimulationSettings settings() const
    {
        SimulationSettings settings = attracting(GetParam().max_cluster_size);
        settings.kinds.front().softening = GetParam().softening;
        settings.gravity->precision = GetParam().precision;
        return settings;
    }
};

// No distance, no force, with or without softening. A cluster's members differ from its centre by rounding
// alone, which can only come from the mean of equal numbers: 1e-12 is a thousand units in the last place.
TEST_P(CoincidentParticles, OfOneVelocityStayTogether)
{
    for (const std::size_t count : {2, 3, 1000}) {
        ParticleSet initial(count, Particle{middle, {1, -2, 0.5}, 0, 1});
        for (std::size_t i = 0; i < count; ++i)
            initial[i].id = i;
        const ParticleSet particles = particles_after(settings(), initial);
        expect_straight_on(initial, particles, frame_count * settings().time.step, 1e-12 * middle.norm());
    }
}

TEST_P(CoincidentParticles, FlyApartWithoutBreakingAnything)
{
    ParticleSet initial;
    add_cloud(initial, {.count = 300}, 3);
    for (Particle& particle : initial)
        particle.position = middle;
    particles_after(settings(), initial);
}

INSTANTIATE_TEST_SUITE_P(
    All, CoincidentParticles,
    testing::Values(Coincidence{0, Precision::Mixed, 1}, Coincidence{0, Precision::Double, 1},
                    Coincidence{0.1, Precision::Mixed, 1}, Coincidence{0.1, Precision::Double, 1},
                    Coincidence{0, Precision::Mixed, 16}, Coincidence{0, Precision::Double, 16},
                    Coincidence{0.1, Precision::Mixed, 16}, Coincidence{0.1, Precision::Double, 16}));

TEST(TenThousandCoincidentParticles, AreDividedByNumberAndNoFurther)
{
    ParticleSet initial(10'000, Particle{middle, {0, 0, 0}, 0, 1e-4F});
    for (std::size_t i = 0; i < initial.size(); ++i)
        initial[i].id = i;
    Simulation simulation(attracting(8), initial, {});
    for (int frame = 0; frame < frame_count; ++frame) {
        const Snapshot& snapshot = simulation.step({.clusters = true});
        EXPECT_LE(snapshot.counts.pools, 65U); // a k-d tree of the greatest depth, its leaves but one empty
        EXPECT_LE(snapshot.counts.clusters, initial.size() / 4); // half full or better
        EXPECT_LE(std::ranges::max(snapshot.clusters.count), 8U);
    }
    expect_straight_on(initial, simulation.particles(), 0, 0);
}

class Massless : public testing::TestWithParam<double> {};

// Weightless clusters have a centre, by number; members keep their float offsets from it, of at most 5 in
// position and 2 in velocity, through a handful of formings of one rounding each. The velocities' act for the
// whole time.
TEST_P(Massless, G24_ParticlesMoveStraightOn)
{
    ParticleSet initial;
    add_cloud(initial, {.count = 1000, .centre = middle}, 4);
    for (Particle& particle : initial)
        particle.mass = 0;
    const SimulationSettings settings = attracting(GetParam());
    const double time = frame_count * settings.time.step;
    const double tolerance = GetParam() < 2 ? 1e-12 * middle.norm() : 8 * 0x1p-24 * (5 + 2 * time);
    expect_straight_on(initial, particles_after(settings, initial), time, tolerance);
}

INSTANTIATE_TEST_SUITE_P(ClusterSizes, Massless, testing::Values(1, 2, 16, 4096));

} // namespace
} // namespace slod::test
