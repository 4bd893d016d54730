#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/leapfrog.hpp"
#include "support/small_scenes.hpp"
#include "support/stellar_systems.hpp"

// The same motion elsewhere, on the fly, and in units far from one.
namespace slod::test {
namespace {

constexpr int frame_count = 100;

SimulationSettings settings_of_eight(Precision precision)
{
    SimulationSettings settings = quiet_settings();
    settings.time.step = figure_eight_turn / 1000;
    settings.kinds.front().softening = 0;
    settings.gravity.emplace();
    settings.gravity->precision = precision;
    settings.background.max_cluster_size = 1;
    return settings;
}

ParticleSet run(const SimulationSettings& settings, const ParticleSet& initial)
{
    Simulation simulation(settings, initial, {});
    for (int frame = 0; frame < frame_count; ++frame)
        simulation.step({});
    return simulation.particles();
}

/// The figure of eight after the run, as seen from where it is and how it flies.
ParticleSet eight_in(const Vector3d& shift, const Vector3d& boost)
{
    const SimulationSettings settings = settings_of_eight(Precision::Mixed);
    ParticleSet particles = figure_eight();
    for (Particle& particle : particles) {
        particle.position += shift;
        particle.velocity += boost;
    }
    particles = run(settings, particles);
    for (Particle& particle : particles) {
        particle.position -= shift + frame_count * settings.time.step * boost;
        particle.velocity -= boost;
    }
    return particles;
}

// At 1e7 a coordinate is rounded by 1e-9 at most, a hundred times.
TEST(MovedEight, G27_FarFromTheOriginThreeBodiesMoveAlike)
{
    const ParticleSet here = eight_in({0, 0, 0}, {0, 0, 0});
    EXPECT_GT(largest_distance(here, figure_eight()), 0.1);
    for (const Vector3d& shift : {Vector3d(1e6, -1e6, 1e6), Vector3d(1e7, 0, 0), Vector3d(1e7, -1e7, 1e7)})
        expect_at_most("largest distance from the run at the origin",
                       largest_distance(eight_in(shift, {0, 0, 0}), here), 1e-6);
}

TEST(MovedEight, G28_OnTheFlyThreeBodiesMoveAlike)
{
    const ParticleSet here = eight_in({0, 0, 0}, {0, 0, 0});
    for (const Vector3d& boost : {Vector3d(1e3, 0, 0), Vector3d(-1e3, 1e3, 1e3)})
        expect_at_most("largest distance from the run at rest",
                       largest_distance(eight_in({0, 0, 0}, boost), here), 1e-6);
}

/// What was merged and split, frame by frame, and what clusters that left.
struct MergeLog {
    std::vector<std::uint64_t> merges, splits;
    std::vector<std::vector<std::uint32_t>> sizes; ///< particles of each cluster, in the order of their slots

    std::uint64_t total() const
    {
        std::uint64_t sum = 0;
        for (const std::uint64_t frame : merges)
            sum += frame;
        return sum;
    }
};

/// A cloud in rigid motion, whose clusters may have 16 stars, in the middle of a cell and all in one of its
/// pools: planes between pools stand still, and what is on the fly crosses them.
MergeLog merges_of(VelocityReference reference, const Vector3d& boost)
{
    SimulationSettings settings = quiet_settings();
    settings.gravity.emplace();
    settings.motion.motion = Motion::Rigid;
    settings.motion.build_respects_limits = true;
    settings.background.max_cluster_size = 16;
    settings.background.pool_factor = 64;
    settings.background.max_breadth = 65'536;
    settings.background.velocity_reference = reference;
    ParticleSet particles;
    add_cloud(particles, {.count = 1000, .centre = Vector3d::Constant(20'000), .velocity = boost}, 5);
    Simulation simulation(settings, particles, {});
    MergeLog log;
    for (int frame = 0; frame < frame_count; ++frame) {
        const Snapshot& snapshot = simulation.step({.clusters = true});
        log.merges.push_back(snapshot.counts.merges);
        log.splits.push_back(snapshot.counts.splits);
        log.sizes.push_back(snapshot.clusters.count);
    }
    return log;
}

/// Frames in which anything differs.
std::size_t frames_that_differ(const MergeLog& a, const MergeLog& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.merges.size(); ++i)
        count += a.merges[i] != b.merges[i] || a.splits[i] != b.splits[i] || a.sizes[i] != b.sizes[i] ? 1 : 0;
    return count;
}

const Vector3d boost(1024, -1024, 1024); ///< that is added with little rounding

TEST(Boost, G28_ChangesNoMergeWhereVelocitiesAreComparedWithTheSurroundings)
{
    const MergeLog at_rest = merges_of(VelocityReference::Surroundings, {0, 0, 0});
    const MergeLog on_the_fly = merges_of(VelocityReference::Surroundings, boost);
    expect_at_least("merges", double(at_rest.total()), 100);
    expect_at_most("frames with other merges, splits or clusters",
                   double(frames_that_differ(at_rest, on_the_fly)), 0);
}

// To the letter of the paper velocities are those in the scene's axes: all that fly along are alike.
TEST(Boost, G28_AllowsAllMergesWhereVelocitiesAreComparedAsTheyAre)
{
    const MergeLog at_rest = merges_of(VelocityReference::Rest, {0, 0, 0});
    const MergeLog on_the_fly = merges_of(VelocityReference::Rest, boost);
    expect_at_least("clusters at rest, of those on the fly, after the first frame",
                    double(at_rest.sizes.front().size()) / double(on_the_fly.sizes.front().size()), 2);
    expect_at_most("splits on the fly", double(on_the_fly.splits.front()), 0);
}

/// Powers of ten of a scene's lengths, masses and times beside those of the figure of eight.
struct Scaling {
    const char* name;
    double length, mass, time;

    friend std::ostream& operator<<(std::ostream& out, const Scaling& scaling) { return out << scaling.name; }
};

class Scaled : public testing::TestWithParam<Scaling> {};

INSTANTIATE_TEST_SUITE_P(Scene, Scaled,
                         testing::Values(Scaling{"atoms", 1e-12, 1e-36, 1},
                                         Scaling{"galaxies", 1e12, 1e36, 1}, Scaling{"slow", 1e8, 1, 1e12},
                                         Scaling{"fast", 1e-8, 1, 1e-12},
                                         Scaling{"light", 1e-12, 1e-30, 1e-3},
                                         Scaling{"heavy", 1e12, 1e30, 1e3}),
                         [](const auto& tested) { return std::string(tested.param.name); });

// A mass is a float, so the length is that which belongs to what is left of it. Nothing else is rounded
// otherwise but in the last place, a hundred times, in a motion that is stable.
TEST_P(Scaled, G29_TheRunIsTheSame)
{
    const auto [name, wanted_length, wanted_mass, time] = GetParam();
    const double mass = float(wanted_mass);
    const double length = wanted_length * std::cbrt(mass / wanted_mass);
    SimulationSettings settings = settings_of_eight(Precision::Double);
    const ParticleSet base = run(settings, figure_eight());
    settings.time.step *= time;
    ParticleSet particles = figure_eight();
    for (Particle& particle : particles) {
        particle.position *= length;
        particle.velocity *= length / time;
        particle.mass = float(mass);
    }
    particles = run(settings, particles);
    double velocities = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles[i].position /= length;
        particles[i].velocity *= time / length;
        velocities = std::max(velocities, (particles[i].velocity - base[i].velocity).norm());
    }
    EXPECT_GT(largest_distance(base, figure_eight()), 0.1);
    expect_at_most("largest distance from the run in units of one", largest_distance(particles, base), 1e-10);
    expect_at_most("largest difference of a velocity", velocities, 1e-10);
}

} // namespace
} // namespace slod::test
