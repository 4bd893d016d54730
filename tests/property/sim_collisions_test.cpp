#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/meshes.hpp"
#include "support/random_draws.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// Clusters among colliders: nobody is lost, made or let through, however clusters are taken apart and formed.
namespace slod::test {
namespace {

/// A hollow cube of six thick boxes with a ball in the middle.
std::vector<ColliderSettings> closed_room(double half_side)
{
    std::vector<ColliderSettings> walls{with(sphere({0, 0, 0}, 0.5), 0.9, 0.1)};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vector3d half_extent = Vector3d::Constant(2 * half_side);
            half_extent[axis] = 0.05;
            walls.push_back(
                with(box(side * (half_side + 0.05) * Vector3d::Unit(axis), half_extent), 0.9, 0.1));
        }
    }
    return walls;
}

class ClosedRoom : public testing::TestWithParam<Motion> {
protected:
    /// Fast particles, several walls wide in a frame, under all uniform fields.
    SimulationSettings settings() const
    {
        SimulationSettings settings = quiet_settings();
        settings.motion.motion = GetParam();
        settings.background.max_cluster_size = 64;
        settings.uniform_gravity.emplace();
        settings.linear_drag = LinearDragSettings{0.1};
        settings.uniform_wind = UniformWindSettings{{3, 1, 0}};
        settings.colliders = closed_room(2);
        return settings;
    }

    static bool inside(const Vector3d& x, double half_side)
    {
        return x.cwiseAbs().maxCoeff() <= half_side + 1e-6 && x.norm() >= 0.5 - 1e-6; // a float of 4, rounded
    }
};

void expect_all_stay(const SimulationSettings& settings, bool (*inside)(const Vector3d&, double))
{
    ParticleSet initial = ball(1000, 0.6, 200, 1, {0, 0, 1.2});
    give_masses(initial, 0.5, 1.5, 2);
    Simulation simulation(settings, initial, {});
    double mass = 0;
    for (const Particle& particle : initial)
        mass += double(particle.mass);
    for (int frame = 0; frame < 300; ++frame) {
        const Snapshot& now = simulation.step({.clusters = false, .conserved = true});
        ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
        ASSERT_EQ(now.counts.particles, initial.size());
        // A sum of a thousand masses in any order: as many half roundings.
        ASSERT_NEAR(now.conserved.mass, mass, 1000 * 0x1p-53 * mass) << "frame " << frame;
    }
    const ParticleSet now = simulation.particles();
    ASSERT_EQ(now.size(), initial.size());
    std::size_t out = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_EQ(now[i].id, initial[i].id);
        EXPECT_EQ(now[i].mass, initial[i].mass);
        out += inside(now[i].position, 2) ? 0 : 1;
    }
    expect_at_most("particles out of the room, of " + std::to_string(now.size()), double(out), 0);
}

TEST_P(ClosedRoom, F10_LosesNobodyAndLetsNobodyOut)
{
    expect_all_stay(settings(), inside);
}

// A hollow cube with walls of a millimetre, and a smaller one in its middle.
TEST_P(ClosedRoom, F10_OfTrianglesLosesNobodyAndLetsNobodyOut)
{
    SimulationSettings scene = settings();
    scene.colliders = {with(sheet(box_mesh({2, 2, 2})), 0.9, 0.1),
                       with(sheet(box_mesh({0.4, 0.4, 0.4})), 0.9, 0.1)};
    expect_all_stay(scene, [](const Vector3d& x, double half_side) {
        const double reach = x.cwiseAbs().maxCoeff();
        return reach <= half_side && reach >= 0.4;
    });
}

// A ball that is hollow, of which what is around it and a ball in its middle are solid by one grid. What is
// linear between samples is above the distance from the middle, which is convex, by at most 3/8 of the
// spacing squared over the least distance of a cell there, 0.4 - 0.18: 0.02.
TEST_P(ClosedRoom, F10_OfAGridOfDistancesLosesNobodyAndLetsNobodyOut)
{
    SimulationSettings scene = settings();
    const auto distance = [](const Vector3d& x) { return std::min(2 - x.norm(), x.norm() - 0.4); };
    scene.colliders = {with(sheet(sampled({43, 43, 43}, {-2.13, -2.12, -2.11}, 0.101, distance)), 0.9, 0.1)};
    expect_all_stay(
        scene, [](const Vector3d& x, double half_side) { return x.norm() <= half_side && x.norm() >= 0.38; });
}

TEST_P(ClosedRoom, CountsBirthsAndDeathsExactly)
{
    SimulationSettings scene = settings();
    scene.emitters = {jet("short"), jet("fast")};
    for (EmitterSettings& emitter : scene.emitters)
        emitter.position = {0, 0, 1};
    scene.emitters[0].cone_angle_deg = 180;
    scene.emitters[1].speed =
        150; // most are out of the room at the end of their first frame but for the walls
    scene.emitters[1].cone_angle_deg = 180;
    scene.emitters[1].lifetime = 2;
    Simulation simulation(scene, {}, {});
    std::uint64_t born = 0, died = 0;
    for (int frame = 1; frame <= 400; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        born += counts.born;
        died += counts.died;
        ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
        ASSERT_EQ(counts.particles, born - died) << "frame " << frame;
    }
    // 640 in each of 6.25 units of time; of those that started exactly a life ago the last frame was the
    // last.
    EXPECT_EQ(born, 2 * 4000U);
    EXPECT_EQ(simulation.particles().size(), 319 + 1279U);
    for (const Particle& particle : simulation.particles())
        EXPECT_TRUE(inside(particle.position, 2)) << particle.position.transpose();
}

INSTANTIATE_TEST_SUITE_P(Motions, ClosedRoom, testing::Values(Motion::Flow, Motion::Stream, Motion::Rigid));

// A cluster of 64 among colliders is 64 particles by themselves, up to the rounding of offsets to float.
// Every other one dies, some of them in the frame in which their cluster is taken apart.
TEST(Collisions, OfClustersAreThoseOfTheirMembers)
{
    SimulationSettings settings = quiet_settings();
    settings.uniform_gravity.emplace();
    settings.colliders = {with(plane({0, 0, 0}, {0.1, 0.2, 1}), 0.6, 0.3)};
    ParticleSet initial = ball(256, 0.3, 0.5, 5, {0, 0, 1});
    for (std::size_t i = 0; i < initial.size(); i += 2)
        initial[i].expiry_frame = std::uint32_t(20 + i % 64);
    ParticleSet results[2];
    for (const double size : {1.0, 64.0}) {
        settings.background.max_cluster_size = size;
        Simulation simulation(settings, initial, {});
        for (int frame = 0; frame < 100; ++frame)
            simulation.step({});
        results[size > 1 ? 1 : 0] = simulation.particles();
    }
    // Two formings in a hundred frames round by 1e-7 each; a bounce on a plane turns errors and grows none.
    ASSERT_EQ(results[1].size(), initial.size() / 2);
    for (std::size_t i = 0; i < results[1].size(); ++i)
        EXPECT_LE((results[0][i].position - results[1][i].position).norm(), 1e-4) << "particle " << i;
}

TEST(Collisions, LeaveClustersThatTouchNothingAsTheyAre)
{
    SimulationSettings settings = quiet_settings();
    settings.uniform_gravity.emplace();
    const ParticleSet initial = ball(256, 0.3, 0.5, 5, {0, 0, 100});
    Simulation without(settings, initial, {});
    settings.colliders = one_of_each();
    Simulation with_colliders(settings, initial, {});
    for (int frame = 0; frame < 30; ++frame) {
        without.step({});
        const FrameCounts& counts = with_colliders.step({}).counts;
        ASSERT_EQ(counts.struck + counts.taken_apart + counts.impacts, 0U);
    }
    const ParticleSet a = without.particles(), b = with_colliders.particles();
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_EQ(a[i].position, b[i].position);
}

// A flat disc of radius 1, as high as a tenth of that over the ground, sinks towards it: the ball around it
// is in the ground all the time, its members are for the last frame or two of the fall.
TEST(Collisions, AskMembersWhereTheBallAroundThemIsInASolid)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_breadth = 8;
    settings.uniform_gravity.emplace();
    settings.colliders = {with(plane({0, 0, 0}, {0, 0, 1}), 0.5, 0)};
    ParticleSet disc = ball(64, 1, 0, 3, {0, 0, 0.1});
    for (Particle& particle : disc)
        particle.position.z() = 0.1;
    Simulation simulation(settings, disc, {});
    // h^2 n^2 g / 2 is 0.1 after so many frames of length h.
    const auto falling = int(std::sqrt(0.2 / 9.81) / settings.time.step);
    for (int frame = 1; frame <= falling; ++frame)
        ASSERT_EQ(simulation.step({}).counts.struck, 0U) << "frame " << frame;
    EXPECT_EQ(simulation.step({}).counts.impacts, disc.size());
}

// One of two falls onto the ground; the other one flies on in the cluster that both were in.
TEST(Collisions, LeaveMembersThatTouchNothingInTheirClusters)
{
    SimulationSettings settings = quiet_settings();
    settings.uniform_gravity.emplace();
    settings.colliders = {with(plane({0, 0, 0}, {0, 0, 1}), 0.5, 0)};
    const ParticleSet initial{{{0, 0, 0.02}, {0, 0, -1}, 1, 1}, {{0, 0, 0.4}, {0, 0, -1}, 2, 1}};
    Simulation simulation(settings, initial, {});
    const std::vector<std::uint64_t> formations = simulation.snapshot({.clusters = true}).clusters.formation;
    ASSERT_EQ(formations.size(), 1U);
    int frame = 0;
    while (frame < 10 && simulation.step({.clusters = true}).counts.impacts == 0)
        ++frame;
    const Snapshot& now = simulation.snapshot({.clusters = true});
    ASSERT_EQ(now.clusters.formation.size(), 2U);
    EXPECT_EQ(now.clusters.formation.front(), formations.front());
    const ParticleSet particles = simulation.particles();
    EXPECT_GT(particles[0].velocity.z(), 0);
    EXPECT_LT(particles[1].velocity.z(), -1);
}

// Two that attract each other under drag, beside a wall so near that the bend of its way in the first frame,
// an eighth of 1/64^2, might take one of them there.
TEST(Collisions, LeaveSingleParticlesThatTouchNothingOnTheirWays)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 1;
    settings.gravity.emplace();
    settings.uniform_gravity.emplace();
    settings.linear_drag.emplace();
    const ParticleSet initial{{{0, 0, 0}, {0, 0.5, 0}, 1, 1}, {{1, 0, 0}, {0, -0.5, 0}, 2, 1}};
    Simulation without(settings, initial, {});
    settings.colliders = {with(plane({-1e-5, 0, 0}, {1, 0, 0}), 1, 0)};
    Simulation with_wall(settings, initial, {});
    std::uint64_t struck = 0;
    for (int frame = 0; frame < 8; ++frame) {
        without.step({});
        const FrameCounts& counts = with_wall.step({}).counts;
        struck += counts.struck;
        ASSERT_EQ(counts.impacts, 0U);
    }
    EXPECT_GT(struck, 0U);
    const ParticleSet a = without.particles(), b = with_wall.particles();
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
        EXPECT_EQ(a[i].velocity, b[i].velocity);
    }
}

TEST(Collisions, FollowTheWindWhenItChanges)
{
    SimulationSettings settings = quiet_settings();
    settings.uniform_gravity.emplace();
    settings.linear_drag.emplace();
    settings.uniform_wind.emplace();
    settings.colliders = {with(plane({0, 0, 0}, {0, 0, 1}), 0, 0)};
    Simulation simulation(settings, {{{0, 0, 0}, {0, 0, 0}, 1, 1}}, {});
    for (int frame = 0; frame < 10; ++frame)
        simulation.step({});
    EXPECT_EQ(simulation.particles().front().position, Vector3d(0, 0, 0));
    settings.uniform_wind->velocity = {2, 0, 0};
    ASSERT_EQ(simulation.change_settings(settings), Problems{});
    simulation.step({});
    EXPECT_GT(simulation.particles().front().velocity.x(), 0);
    settings.colliders.clear();
    ASSERT_EQ(simulation.change_settings(settings), Problems{});
    simulation.step({});
    EXPECT_LT(simulation.particles().front().position.z(), 0) << "nothing holds it any more";
}

// A cluster of two that a spring of acceleration 10 draws onto a floor, in a region for what is accelerated
// by 5 or more. Where it is formed anew after the impact, that is where it belongs, before forces are
// evaluated.
TEST(Collisions, LeaveTheAccelerationThatRegionsAreChosenBy)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 4;
    settings.background.max_breadth = 4;
    settings.fields.of<Spring>() = {{.anchor = {0, 0, -10}}};
    settings.colliders = {with(plane({0, 0, 0}, {0, 0, 1}), 1, 0)};
    RegionOfInterest pulled;
    pulled.name = "pulled";
    pulled.shape = Shape::Sphere;
    pulled.radius = 100;
    pulled.partition = settings.background;
    pulled.least_acceleration = 5;
    settings.regions = {pulled};
    Simulation simulation(settings, {{{1, 1, 0.01}, {0, 0, -3}, 0, 1}, {{1, 1.125, 0.01}, {0, 0, -3}, 1, 1}},
                          {});
    const Snapshot& now = simulation.step({.clusters = true});
    EXPECT_EQ(now.counts.impacts, 2U);
    for (const std::uint16_t region : now.clusters.region)
        EXPECT_EQ(region, 1);
}

} // namespace
} // namespace slod::test
