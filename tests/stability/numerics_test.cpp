#include <algorithm>
#include <array>
#include <cmath>
#include <immintrin.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/direct_sum_oracle.hpp"
#include "support/small_scenes.hpp"

// What floating-point numbers do to a simulation: denormals, sums of many terms, their order, float beside
// double, and clocks that run for years.
namespace slod::test {
namespace {

/// Bits of the control register that are settings; the others are flags that every operation may raise.
unsigned control_bits()
{
    return _mm_getcsr() & ~0x3fU;
}

TEST(Denormals, N02_ASimulationLeavesTheCallersControlRegisterAsItWas)
{
    std::size_t calls = 0, changed = 0;
    const auto look = [&](unsigned before) {
        ++calls;
        changed += control_bits() == before ? 0 : 1;
    };
    ThreadTeam(3).run([&] {
        for (const SmallScene& scene : small_scenes()) {
            const unsigned before = control_bits();
            Simulation simulation(scene.settings, scene.initial, {});
            look(before);
            for (int frame = 0; frame < 4; ++frame) {
                simulation.step({.clusters = true, .conserved = true, .error_pairs = 1000});
                look(before);
            }
            simulation.particles();
            simulation.state_hash();
            look(before);
        }
    });
    report_value("calls", double(calls));
    expect_at_most("calls that leave another control register", double(changed), 0);
}

// Particles at the origin with velocities of 1e-310: what flushes leaves them there to the bit, what does
// not moves them by 1e-312 a frame.
TEST(Denormals, N02_VelocitiesThatAreDenormalMoveNothing)
{
    for (const Motion motion : {Motion::Flow, Motion::Rigid}) {
        for (const double size : {1.0, 64.0}) {
            SimulationSettings settings = quiet_settings();
            settings.motion.motion = motion;
            settings.background.max_cluster_size = size;
            settings.background.max_breadth = 1;
            ParticleSet particles(64);
            for (std::size_t i = 0; i < particles.size(); ++i)
                particles[i] = {
                    .position = {0, 0, 0}, .velocity = {1e-310, -2e-310, 3e-320}, .id = i, .mass = 1};
            Simulation simulation(settings, particles, {});
            for (int frame = 0; frame < 20; ++frame)
                simulation.step({});
            double farthest = 0;
            for (const Particle& particle : simulation.particles())
                farthest = std::max(farthest, particle.position.cwiseAbs().maxCoeff());
            expect_at_most("largest coordinate after 20 frames", farthest, 0);
        }
    }
}

/// A particle of 2^24, as which a float stops counting ones, and 5,000 of 1 about it that move with it, in a
/// ball of radius a half; the last has no mass and is far off, at rest.
ParticleSet heavy_and_many()
{
    constexpr std::size_t ones = 5000;
    ParticleSet particles = ball(ones + 2, 0.5, 0, 3);
    for (Particle& particle : particles)
        particle.velocity = {1, 0, 0};
    particles[0].mass = 0x1p24F;
    particles.back().mass = 0;
    particles.back().position = {100, 0, 0};
    particles.back().velocity = {0, 0, 0};
    return particles;
}

// Whole numbers below 2^53 have exact sums in double, in any order and in clusters of any size.
TEST(LongSums, N07_MassAndMomentumOfManyOnesBesideAHeavyParticleAreExact)
{
    const double expected = 0x1p24 + 5000;
    for (const Motion motion : {Motion::Flow, Motion::Rigid}) {
        for (const double size : {1.0, 64.0, 1e6}) {
            SimulationSettings settings = quiet_settings();
            settings.motion.motion = motion;
            settings.background.max_cluster_size = size;
            settings.background.max_breadth = 1024;
            Simulation simulation(settings, heavy_and_many(), {});
            for (int frame = 0; frame < 3; ++frame) {
                const ConservedQuantities& sums = simulation.step({.conserved = true}).conserved;
                expect_at_most("error of the mass", std::abs(sums.mass - expected), 0);
                // Of a cluster it is the mass times a mean velocity, whose rounding the sum has.
                expect_at_most("relative error of the momentum", std::abs(sums.momentum.x() / expected - 1),
                               4 * std::numeric_limits<double>::epsilon());
            }
        }
    }
}

// In mixed precision up to 511 ones of a chunk of 512 drown in the heavy one's pull, as 2^24 + 1 is no float,
// and terms have 16 roundings of 2^-24; chunks are added in double. In double the sum of n terms is good to n
// roundings of 2^-53. All sums in float would lose all 5,000 ones, 3e-4.
TEST(LongSums, N07_ThePullOfManyOnesBesideAHeavyParticleIsTheSumOfAll)
{
    const ParticleSet particles = heavy_and_many();
    std::vector<PointMass> bodies;
    for (const Particle& particle : particles)
        bodies.push_back({particle.position, double(particle.mass), 0.05 * 0.05 / 2});
    const PointMass& tracer = bodies.back();
    const double exact = acceleration_at(tracer.position, tracer.q, bodies, 1).x();
    const std::array<std::pair<Precision, double>, 2> limits{
        {{Precision::Mixed, (512 + 16) * 0x1p-24}, {Precision::Double, 5002 * 0x1p-53}}};
    for (const auto& [precision, limit] : limits) {
        SimulationSettings settings = quiet_settings();
        settings.background.max_cluster_size = 1;
        settings.gravity.emplace();
        settings.gravity->precision = precision;
        settings.gravity->direct_below = 10'000;
        settings.time.step = 1e-11; // in which the pull moves nobody by more than a rounding
        Simulation simulation(settings, particles, {});
        simulation.step({});
        const double pull = simulation.particles().back().velocity.x() / settings.time.step;
        expect_at_most(std::string("relative error of the pull, ") +
                           std::string(names(precision)[std::size_t(precision)]),
                       std::abs(pull / exact - 1), limit);
    }
}

/// The same particles in another order.
ParticleSet shuffled(ParticleSet particles, std::uint64_t seed)
{
    Random random(seed, 0, 0);
    for (std::size_t left = particles.size(); left > 1; --left)
        std::swap(particles[left - 1], particles[random.bits() % left]);
    return particles;
}

/// What a frame of self-gravity in double makes of particles that start in this order, by id.
ParticleSet after_a_frame(const ParticleSet& initial, Motion motion, double max_cluster_size)
{
    SimulationSettings settings = quiet_settings();
    settings.motion.motion = motion;
    settings.background.max_cluster_size = max_cluster_size;
    settings.background.max_breadth = 64;
    settings.gravity.emplace();
    settings.gravity->precision = Precision::Double;
    Simulation simulation(settings, initial, {});
    simulation.step({});
    return simulation.particles();
}

/// |a - b| of velocities by id, relative to the largest |b - initial|.
std::vector<double> velocity_differences(const ParticleSet& a, const ParticleSet& b,
                                         const ParticleSet& initial)
{
    double scale = 0;
    std::vector<double> differences;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].id, b[i].id);
        differences.push_back((a[i].velocity - b[i].velocity).norm());
        scale = std::max(scale, (b[i].velocity - initial[i].velocity).norm());
    }
    for (double& difference : differences)
        difference /= scale;
    return differences;
}

TEST(OrderOfInput, N08_ChangesForcesInDoubleByNoMoreThanRoundings)
{
    const ParticleSet particles = plummer_sphere(1000, 4);
    for (const auto& [motion, size] :
         {std::pair(Motion::Flow, 1.0), {Motion::Rigid, 1.0}, {Motion::Rigid, 64.0}}) {
        const ParticleSet expected = after_a_frame(particles, motion, size);
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const auto differences = velocity_differences(
                after_a_frame(shuffled(particles, seed), motion, size), expected, particles);
            expect_at_most(size == 1 ? "relative difference, unclustered"
                                     : "relative difference, 64 per cluster",
                           *std::max_element(differences.begin(), differences.end()), 1e-12);
        }
    }
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Pools are numbered as their first particles come, and take their turns by their numbers: in flow another
// order makes other clusters, which are off by as much. The median error of 1000 members has a standard error
// of 1.25 / sqrt(1000) of the errors' spread, 4 %, and a ratio of two 6 %; three of these are allowed.
TEST(OrderOfInput, N08_OfClustersThatReformChangesNothingAboutTheirError)
{
    const ParticleSet particles = plummer_sphere(1000, 4);
    const ParticleSet exact = after_a_frame(particles, Motion::Flow, 1);
    const auto error = [&](const ParticleSet& initial) {
        return median(velocity_differences(after_a_frame(initial, Motion::Flow, 64), exact, particles));
    };
    const double in_order = error(particles);
    for (std::uint64_t seed = 0; seed < 4; ++seed)
        expect_within("median error of forces in another order, in that of the first",
                      error(shuffled(particles, seed)) / in_order, 1 / 1.18, 1.18);
}

/// Radii about the origin that hold a tenth, a half and nine tenths of the particles.
std::array<double, 3> holding_radii(const ParticleSet& particles)
{
    std::vector<double> radii;
    for (const Particle& particle : particles)
        radii.push_back(particle.position.norm());
    std::sort(radii.begin(), radii.end());
    const std::size_t n = radii.size();
    return {radii[n / 10], radii[n / 2], radii[n * 9 / 10]};
}

// What another seed changes is the floor: no measurement of such a galaxy is better.
TEST(FloatBesideDouble, N13_MovesAGalaxysRadiiByLessThanAnotherSeedDoes)
{
    constexpr int frames = 128; // two units of time, most of a crossing
    const auto history = [](Precision precision, std::uint64_t seed, double size) {
        SimulationSettings settings = quiet_settings();
        settings.background.max_cluster_size = size;
        settings.gravity.emplace();
        settings.gravity->precision = precision;
        Simulation simulation(settings, plummer_sphere(1000, seed), {});
        std::vector<std::array<double, 3>> radii;
        for (int frame = 0; frame < frames; ++frame) {
            simulation.step({});
            if (frame % 4 == 3)
                radii.push_back(holding_radii(simulation.particles()));
        }
        return radii;
    };
    const std::array<std::string, 3> shares{"10 %", "50 %", "90 %"};
    for (const double size : {1.0, 8.0}) {
        const auto in_double = history(Precision::Double, 1, size),
                   mixed = history(Precision::Mixed, 1, size), other = history(Precision::Double, 2, size);
        CasePicture picture{.title = size == 1 ? "Half-mass radius, unclustered"
                                               : "Half-mass radius, 8 per cluster",
                            .x_axis = "time",
                            .y_axis = "radius",
                            .curves = {{"double", {}, {}}, {"mixed", {}, {}}, {"another seed", {}, {}}}};
        for (std::size_t share = 0; share < 3; ++share) {
            double difference = 0, floor = 0;
            for (std::size_t i = 0; i < mixed.size(); ++i) {
                difference += std::pow(mixed[i][share] - in_double[i][share], 2);
                floor += std::pow(other[i][share] - in_double[i][share], 2);
            }
            expect_at_most("difference of the radius of " + shares[share] + ", in seeds'",
                           std::sqrt(difference / floor), 1);
        }
        for (std::size_t i = 0; i < mixed.size(); ++i) {
            std::size_t curve = 0;
            for (const auto* radii : {&in_double, &mixed, &other}) {
                picture.curves[curve].x.push_back(double(i + 1) / 16);
                picture.curves[curve++].y.push_back((*radii)[i][1]);
            }
        }
        report_picture(picture);
    }
}

// A clock that added up its steps of a 60th would be off by hundreds of units in the last place.
TEST(Clock, N15_IsAWholeNumberOfStepsToHalfAUnitInTheLastPlace)
{
    SimulationSettings settings = quiet_settings();
    settings.time.step = 1.0 / 60;
    settings.background.max_cluster_size = 1;
    Simulation simulation(settings, ball(1, 1, 0, 1), {});
    double worst = 0;
    for (std::uint64_t frame = 1; frame <= 200'000; ++frame) {
        const Snapshot& now = simulation.step({});
        ASSERT_EQ(now.frame, frame);
        const long double exact = static_cast<long double>(frame) * settings.time.step;
        const double unit = std::nextafter(now.time, INFINITY) - now.time;
        worst = std::max(worst, double(std::abs(static_cast<long double>(now.time) - exact)) / unit);
    }
    expect_at_most("error of the time, units in the last place", worst, 0.5);
}

// The scene has room for 300 particles of some 900 that its emitters would have in the air.
TEST(FullScene, N19_GoesOnAndEmitsAgainWhereParticlesDie)
{
    const SmallScene scene = small_scene("full_fountain");
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t most = 0, refused = 0, born_after = 0;
    for (int frame = 0; frame < 400; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        most = std::max(most, counts.particles);
        born_after += refused > 0 ? counts.born : 0;
        refused += counts.births_refused;
    }
    EXPECT_EQ(simulation.problems(), Problems{});
    expect_at_most("particles", double(most), 300);
    expect_at_least("births refused", double(refused), 1);
    // Each place is taken again when its particle's life of 32 frames ends: twelve lives, of which the first
    // is not counted and the last may be under way.
    expect_at_least("born after the first refusal", double(born_after), 300 * 10);
}

} // namespace
} // namespace slod::test
