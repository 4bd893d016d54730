#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/small_scenes.hpp"

// Bodies that pass each other so closely that a frame has to be cut into steps: point masses, G = 1, in
// double.
namespace slod::test {
namespace {

SimulationSettings point_masses(double step, std::uint32_t max_substeps, double angle)
{
    SimulationSettings settings = quiet_settings();
    settings.kinds.front().softening = 0;
    settings.time = {.step = step, .max_substeps = max_substeps, .substep_angle = angle};
    settings.background.max_cluster_size = 1;
    settings.gravity.emplace();
    settings.gravity->precision = Precision::Double;
    return settings;
}

double energy_of(const ParticleSet& bodies)
{
    double energy = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        energy += 0.5 * double(bodies[i].mass) * bodies[i].velocity.squaredNorm();
        for (std::size_t j = 0; j < i; ++j)
            energy -= double(bodies[i].mass) * double(bodies[j].mass) /
                      (bodies[i].position - bodies[j].position).norm();
    }
    return energy;
}

/// What came of a run.
struct Course {
    std::vector<double> time, error; ///< of the energy, relative, after each frame
    double largest_error = 0;
    std::uint64_t substeps = 0, under_resolved = 0;
    ParticleSet end;
};

Course run(const SimulationSettings& settings, const ParticleSet& initial, double duration)
{
    Simulation simulation(settings, initial, {});
    const double energy = energy_of(initial);
    Course course;
    for (const auto frames = std::uint64_t(std::lround(duration / settings.time.step));
         course.time.size() < frames;) {
        const Snapshot& now = simulation.step({});
        course.substeps += now.counts.substeps;
        course.under_resolved += now.counts.under_resolved;
        course.end = simulation.particles();
        const double error = std::abs(energy_of(course.end) / energy - 1);
        course.largest_error = std::max(course.largest_error, error);
        course.time.push_back(now.time);
        course.error.push_back(std::max(error, 1e-16)); // which a logarithm shows
    }
    return course;
}

void show(const std::string& bodies, const Course& course)
{
    report_picture({.title = bodies + ", frames of 1/60, steps after the tides",
                    .x_axis = "time",
                    .y_axis = "error of the energy",
                    .curves = {{"cut into steps", course.time, course.error}},
                    .log_y = true});
}

/// A light body about a heavy one, of semi-major axis 1, at its greatest distance: a turn takes 2 pi.
ParticleSet eccentric(double e)
{
    const double speed = std::sqrt((1 - e) / (1 + e));
    return {{{0, 0, 0}, {0, 0, 0}, 1, 1}, {{1 + e, 0, 0}, {0, speed, 0}, 2, 1e-12F}};
}

constexpr double turn = 2 * M_PI;

TEST(EccentricOrbit, G03_KeepsItsEnergyWhereFramesAreCutIntoSteps)
{
    const Course course = run(point_masses(1.0 / 60, 20'000, 2e-3), eccentric(0.99), 20 * turn);
    expect_at_most("error of the energy in 20 turns", course.largest_error, 1e-3);
    expect_at_most("evaluations a turn", double(course.substeps) / 20, 2e4);
    expect_at_most("frames flagged under-resolved", double(course.under_resolved), 0);
    show("Orbit of eccentricity 0.99, whose turn takes 2 pi", course);
}

// A thousand steps a turn are far too few for the passage, which takes a thousandth of it.
TEST(EccentricOrbit, G03_IsFlaggedWhereStepsAreTooFew)
{
    for (const std::uint32_t most : {2U, 16U}) {
        const Course course = run(point_masses(turn / 1000, most, 0.1), eccentric(0.99), 2 * turn);
        expect_at_least("frames flagged under-resolved", double(course.under_resolved), 1);
    }
}

// With maps to be carried along tides are there anyway, so every frame is judged: an oscillation that gets
// 0.2 or 2 radians in one.
TEST(StiffSpring, G03_IsFlaggedWithoutStepsWhereClustersHaveMaps)
{
    for (const double angle : {0.2, 2.0}) {
        SimulationSettings settings = quiet_settings();
        const double rate = angle / settings.time.step;
        settings.fields.of<Spring>().push_back({.stiffness = rate * rate / std::sqrt(3.0)});
        ParticleSet particles;
        add_cloud(particles, {.count = 64}, 1);
        Simulation simulation(settings, particles, {});
        std::uint64_t flagged = 0;
        for (int frame = 0; frame < 10; ++frame)
            flagged += simulation.step({}).counts.under_resolved;
        expect_within(angle > 1 ? "frames flagged of 10, at 2 rad a frame"
                                : "frames flagged of 10, at 0.2 rad",
                      double(flagged), angle > 1 ? 10 : 0, angle > 1 ? 10 : 0);
    }
}

ParticleSet pythagoras()
{
    return {{{1, 3, 0}, {0, 0, 0}, 1, 3}, {{-2, -1, 0}, {0, 0, 0}, 2, 4}, {{1, -1, 0}, {0, 0, 0}, 3, 5}};
}

double distance(const ParticleSet& bodies, std::size_t a, std::size_t b)
{
    return (bodies[a].position - bodies[b].position).norm();
}

// Masses of 3, 4 and 5 at rest in the corners of the triangle opposite to the sides so long (Szebehely and
// Peters 1967). Who leaves in the end, and when, hangs on the last digits of every passage before, so it is
// reported alone.
TEST(PythagoreanBodies, G07_KeepTheirEnergyThroughEveryPassage)
{
    const Course course = run(point_masses(1.0 / 60, 1'000'000, 5e-4), pythagoras(), 70);
    expect_at_most("error of the energy", course.largest_error, 1e-5);
    expect_at_most("frames flagged under-resolved", double(course.under_resolved), 0);
    report_value("distance of 4 and 5 at the end", distance(course.end, 1, 2));
    report_value("distance of 3 and 5 at the end", distance(course.end, 0, 2));
    report_value("steps a frame", double(course.substeps) / double(course.time.size()));
    show("Pythagorean three bodies", course);
}

TEST(PythagoreanBodies, G07_AreNumbersAndFlaggedWhereStepsAreTooFew)
{
    const Course course = run(point_masses(1.0 / 60, 2, 0.1), pythagoras(), 70);
    expect_at_least("frames flagged under-resolved", double(course.under_resolved), 1);
    for (const Particle& body : course.end)
        EXPECT_TRUE(body.position.allFinite() && body.velocity.allFinite()) << "body " << body.id;
    report_value("error of the energy, which is to be large", course.largest_error);
}

// Its tide has no symmetric part that pulls apart or together; what it does is turn.
TEST(Whirl, G03_IsCutIntoStepsWithoutClusters)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 1;
    settings.time = {.step = 1.0 / 64, .max_substeps = 1000, .substep_angle = 0.01};
    settings.fields.of<Vortex>().push_back({.strength = 100, .core_radius = 1});
    Simulation simulation(settings, {{{0.1, 0, 0}, {0, 0, 0}, 1, 1}}, {});
    expect_at_least("steps of a frame", double(simulation.step({}).counts.substeps), 2);
}

TEST(SubSteps, G03_AreRefusedWithWhatActsOverWholeFrames)
{
    SimulationSettings settings = quiet_settings();
    settings.time.max_substeps = 2;
    EXPECT_EQ(problems(settings), Problems{});
    std::vector<SimulationSettings> refused(4, settings);
    refused[0].colliders = {small_scene("obstacles").settings.colliders.front()};
    refused[1].sinks = {small_scene("sinks").settings.sinks.front()};
    refused[2].quadratic_drag.emplace();
    refused[3].fields = small_scene("winds").settings.fields;
    refused[3].linear_drag.emplace();
    int sentences = 0;
    for (const SimulationSettings& each : refused) {
        const Problems found = problems(each);
        sentences += !found.empty() && found.front().starts_with("time.max_substeps = 2") ? 1 : 0;
    }
    expect_within("refused, of 4", sentences, 4, 4);
}

// A pair in an orbit that takes 2 pi, in the shortest and in far too long a step.
TEST(AbsurdStep, N05_OfABillionthOfABillionthMovesBodiesAsFarAsItsTime)
{
    SimulationSettings settings = point_masses(1e-12, 1000, 0.1);
    const ParticleSet pair = eccentric(0);
    const Course course = run(settings, pair, 1000e-12);
    const double way = (course.end[1].position - pair[1].position).norm();
    expect_within("way in 1000 steps, over speed times time", way / 1e-9, 1 - 1e-6, 1 + 1e-6);
    expect_at_most("frames flagged under-resolved", double(course.under_resolved), 0);
    expect_at_most("sub-steps a frame", double(course.substeps) / 1000, 1);
}

TEST(AbsurdStep, N05_OfAMillionIsCutIntoAtLeastHalfOfTheStepsAllowedAndFlagged)
{
    const Course course = run(point_masses(1e6, 100, 0.1), eccentric(0), 1e6);
    expect_within("frames flagged under-resolved, of 1", double(course.under_resolved), 1, 1);
    expect_within("sub-steps of the frame, of 100 allowed", double(course.substeps), 50, 100);
    for (const Particle& body : course.end)
        EXPECT_TRUE(body.position.allFinite() && body.velocity.allFinite()) << "body " << body.id;
}

} // namespace
} // namespace slod::test
