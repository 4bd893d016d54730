#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/meshes.hpp"
#include "support/one_cluster.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// Bouncing, resting and sliding over many frames, each particle by itself and in clusters of 64.
namespace slod::test {
namespace {

constexpr double fall = 9.81;

SimulationSettings among(const std::vector<ColliderSettings>& colliders, double step = 1.0 / 60)
{
    SimulationSettings settings = quiet_settings();
    settings.time.step = step;
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -fall}};
    settings.colliders = colliders;
    return settings;
}

ColliderSettings floor_with(double restitution, double friction)
{
    return with(plane({0, 0, 0}, {0, 0, 1}), restitution, friction);
}

std::uint64_t impacts_in(Simulation& simulation, int frames)
{
    std::uint64_t impacts = 0;
    for (int frame = 0; frame < frames; ++frame)
        impacts += simulation.step({}).counts.impacts;
    return impacts;
}

double energy(const Particle& particle)
{
    return 0.5 * particle.velocity.squaredNorm() + fall * particle.position.z();
}

// One from a height of 1, which takes 0.9 of a unit of time to be there again, 11 bounces in 40 frames.
TEST(BouncingParticle, F12_KeepsItsHeightForTenThousandElasticBounces)
{
    Simulation simulation(among({floor_with(1, 0)}, 0.25), {{{0, 0, 1}, {0, 0, 0}, 1, 1}}, {});
    EXPECT_GE(impacts_in(simulation, 36'200), 10'000U); // a bounce every 0.903 units of time
    expect_at_most("drift of the height", std::abs(energy(simulation.particles().front()) / fall - 1), 1e-3);
}

// A cluster that is formed anew rounds offsets and relative velocities to float: at speeds of about 4, half
// an ulp is 2e-7 and changes the height by 2e-7 * 4 / 9.81 = 1e-7 a frame. Were they all of one sign, they
// would reach the bound after 10^4 frames; at random after 10^8. There are 4,200.
TEST(BouncingCluster, F12_KeepsItsHeightsForAThousandElasticBounces)
{
    const ParticleSet initial = ball(64, 0.3, 0.5, 1, {0, 0, 1});
    Simulation simulation(among({floor_with(1, 0)}, 0.25), initial, {});
    EXPECT_GE(impacts_in(simulation, 4200), 64'000U);
    const ParticleSet now = simulation.particles();
    for (std::size_t i = 0; i < now.size(); ++i)
        expect_at_most("drift of the heights", std::abs(energy(now[i]) - energy(initial[i])) / fall, 1e-3);
}

// The flights of a ball of restitution e sum up to (1 + e) / (1 - e) times its first fall.
TEST(BouncingParticle, F15_ComesToRestWhenItsBouncesHaveSummedUp)
{
    const double step = 1.0 / 60, end = 19 * std::sqrt(2 / fall);
    Simulation simulation(among({floor_with(0.9, 0)}, step), {{{0, 0, 1}, {0, 0, 0}, 1, 1}}, {});
    int frames = 0;
    std::uint64_t most = 0;
    for (bool rests = false; !rests && frames < 1000; ++frames) {
        const FrameCounts& counts = simulation.step({}).counts;
        EXPECT_EQ(counts.impacts_cut_off, 0U) << "frame " << frames;
        most = std::max(most, counts.impacts);
        const Particle particle = simulation.particles().front();
        rests = particle.velocity.isZero(0) && particle.position.z() == 0;
    }
    expect_within("frames from the sum of all flights to rest", frames - end / step, -2, 2);
    expect_at_most("impacts in a frame", double(most), 8);
    run(simulation, 100);
    expect_at_most("distance from where it rests, 100 frames on",
                   simulation.particles().front().position.norm(), 1e-6);
}

/// Its mean height at the end of each frame until all are at rest, in 300 frames.
CaseCurve heights(const std::string& name, double restitution, const ParticleSet& initial)
{
    Simulation simulation(among({floor_with(restitution, 0)}), initial, {});
    CaseCurve curve{.name = name, .x = {}, .y = {}};
    for (int frame = 0; frame <= 300; ++frame) {
        double mean = 0;
        for (const Particle& particle : simulation.particles())
            mean += particle.position.z() / double(initial.size());
        curve.x.push_back(frame / 60.0);
        curve.y.push_back(mean);
        simulation.step({});
    }
    return curve;
}

// One after the other the flights of a ball of restitution 1/2 take half as long, 3 first falls in all: 1.35.
TEST(BouncingParticle, F15_HeightsFallWithTheSquareOfTheRestitution)
{
    const ParticleSet one{{{0, 0, 1}, {0, 0, 0}, 1, 1}};
    const CasePicture picture{.title = "Bounces of one ball from a height of 1",
                              .x_axis = "time",
                              .y_axis = "height",
                              .curves = {heights("restitution 0.9", 0.9, one),
                                         heights("restitution 0.5", 0.5, one),
                                         heights("restitution 0", 0, one)}};
    report_picture(picture);
    for (const auto& [row, restitution] : {std::pair(0, 0.9), std::pair(1, 0.5)}) {
        const std::vector<double>& height = picture.curves[std::size_t(row)].y;
        // Between the first and the second impact. A frame's end is half a frame off the top at most.
        const double first = std::sqrt(2 / fall);
        const auto from = std::ptrdiff_t(std::ceil(60 * first)),
                   to = std::ptrdiff_t(60 * first * (1 + 2 * restitution));
        const double top = *std::max_element(height.begin() + from, height.begin() + to);
        expect_within("height of the second flight, of that expected", top / (restitution * restitution),
                      1 - 0.5 * fall / (120.0 * 120) / (restitution * restitution), 1 + 1e-9);
    }
    expect_at_most("height at rest, restitution 0.5", picture.curves[1].y[82], 1e-6);
    expect_at_most("height at rest, restitution 0", picture.curves[2].y[28], 1e-6);
}

/// Particles that have come to rest, and where.
class Rest : public testing::TestWithParam<int> {
protected:
    ParticleSet initial() const { return ball(std::size_t(GetParam()), 0.3, 0.5, 2, {0.7, -0.4, 0.5}); }

    /// Expects that none moves any more in so many frames.
    static void expect_still(Simulation& simulation, int frames, double drift, double speed)
    {
        const ParticleSet before = simulation.particles();
        run(simulation, frames);
        const ParticleSet after = simulation.particles();
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t i = 0; i < after.size(); ++i) {
            expect_at_most("drift", (after[i].position - before[i].position).norm(), drift);
            expect_at_most("speed at rest", after[i].velocity.norm(), speed);
        }
        EXPECT_EQ(simulation.problems(), Problems{});
    }
};

TEST_P(Rest, F16_LastsAHundredThousandFramesOnAPlane)
{
    Simulation simulation(among({floor_with(0.3, 0.5)}), initial(), {});
    for (int frame = 0; frame < 600; ++frame)
        ASSERT_EQ(simulation.step({}).counts.impacts_cut_off, 0U) << "frame " << frame;
    expect_still(simulation, 100'000, 1e-6, 1e-6);
    for (const Particle& particle : simulation.particles())
        // An offset of 0.7, rounded to float once.
        expect_at_most("distance from the floor", std::abs(particle.position.z()), 1e-7);
}

TEST_P(Rest, F17_LastsOnASlopeLessSteepThanItsFriction)
{
    const Vector3d normal(std::sin(M_PI / 6), 0, std::cos(M_PI / 6)); // tan 30 deg = 0.577
    Simulation simulation(among({with(plane({0, 0, 0}, normal), 0, 0.6)}), initial(), {});
    run(simulation, 1200);
    expect_still(simulation, 1000, 1e-4, 1e-4);
}

TEST_P(Rest, F17_TurnsIntoSlidingOnASteeperOne)
{
    const Vector3d normal(std::sin(M_PI / 6), 0, std::cos(M_PI / 6));
    const Vector3d down(std::cos(M_PI / 6), 0, -std::sin(M_PI / 6));
    const double friction = 0.3;
    Simulation simulation(among({with(plane({0, 0, 0}, normal), 0, friction)}), initial(), {});
    run(simulation, 60); // all have landed, and slide
    const ParticleSet before = simulation.particles();
    run(simulation, 60);
    const ParticleSet after = simulation.particles();
    const double expected = fall * (0.5 - friction * std::cos(M_PI / 6));
    for (std::size_t i = 0; i < after.size(); ++i) {
        expect_within("acceleration down the slope, of that expected",
                      down.dot(after[i].velocity - before[i].velocity) / expected, 0.99, 1.01);
        expect_at_most("distance from the slope", std::abs(normal.dot(after[i].position)), 1e-6);
    }
}

TEST_P(Rest, KeepsItsClusters)
{
    Simulation simulation(among({floor_with(0.3, 0.5)}), initial(), {});
    run(simulation, 600);
    const FrameCounts counts = simulation.step({}).counts;
    EXPECT_GT(counts.struck, 0U);
    EXPECT_EQ(counts.taken_apart, 0U);
    EXPECT_EQ(counts.impacts, 0U);
}

INSTANTIATE_TEST_SUITE_P(Particles, Rest, testing::Values(1, 64));

class CrowdAmongColliders : public testing::TestWithParam<Crowd> {
protected:
    static SimulationSettings among_these(const std::vector<ColliderSettings>& colliders)
    {
        SimulationSettings settings = settings_for(GetParam());
        settings.time.step = 1.0 / 60;
        settings.colliders = colliders;
        return settings;
    }
};

INSTANTIATE_TEST_SUITE_P(Crowds, CrowdAmongColliders, testing::ValuesIn(crowds()), name_of);

// A wall of 0.2 that goes 0.83 in a frame, over what lies on a floor. It takes along what it does not throw:
// at its own speed, or half as fast again. Velocities of 75 are rounded to float within a cluster.
TEST_P(CrowdAmongColliders, F21_IsNotPassedByAWallThatSweepsOverIt)
{
    for (const double restitution : {0.0, 0.5}) {
        ColliderSettings wall = with(box({-3, 0, 5}, {0.1, 20, 10}), restitution, 0);
        wall.name = "wall";
        wall.velocity = {50, 0, 0};
        SimulationSettings settings = among_these({floor_with(0, 0), wall});
        settings.uniform_gravity = UniformGravitySettings{{0, 0, -fall}};
        ParticleSet initial = about(GetParam().particles, {0.3, 0.2, 0}, {0, 0, 0}, 0.5);
        for (Particle& particle : initial) {
            particle.position.z() = 0;
            particle.velocity.setZero();
        }
        Simulation simulation(settings, initial, {});
        int passed = 0;
        for (int frame = 1; frame <= 30; ++frame) {
            simulation.step({});
            const double face = -2.9 + 50 * frame / 60.0;
            for (const Particle& particle : simulation.particles())
                passed += particle.position.x() < face - 1e-5 ? 1 : 0; // rounded at 25 to float
        }
        expect_at_most("particles passed, in all frames", passed, 0);
        for (const Particle& particle : simulation.particles())
            expect_at_least("speed, of the wall's", particle.velocity.x() / 50, 1 - 0x1p-23);
    }
}

// Where the way out is not defined: in the middle of each solid, on its axis, where two or three faces are
// equally near, and in the middle of a sheet, on a triangle, an edge and a vertex.
TEST_P(CrowdAmongColliders, F23_LeavesMiddlesEdgesAndApexesWithoutHarm)
{
    struct Start {
        ColliderSettings collider;
        Vector3d place;
    };
    const ColliderSettings block = box({1, 2, 3}, {0.5, 0.5, 0.5}), hut = cone({0, 0, 1}, {0, 0, -1}, 1),
                           rod = capsule({0, 0, 0}, {1, 1, 0}, 0.3), flat = sheet(flat_mesh(5, 5, 1), 0.2);
    double off = 0, fastest = 0;
    int lost = 0;
    for (const Start& start :
         {Start{sphere({1, 2, 3}, 1), {1, 2, 3}}, Start{block, {1, 2, 3}}, Start{block, {1.25, 2.25, 3}},
          Start{block, {1.25, 2.25, 3.25}}, Start{block, {1.5, 2.5, 3.5}}, Start{hut, {0, 0, 1}},
          Start{hut, {0, 0, 0.5}}, Start{hut, {0, 0, std::sqrt(2) - 1}}, Start{hut, {0, 0, 0}},
          Start{rod, {0, 0, 0}}, Start{rod, {0.5, 0.5, 0}}, Start{flat, {2.25, 2.125, 0}},
          Start{flat, {2.5, 2.5, 0}}, Start{flat, {2, 2, 0}}}) {
        const SimulationSettings settings = among_these({start.collider});
        Simulation simulation(settings, about(GetParam().particles, start.place, {0, 0, 0}, 0), {});
        run(simulation, 2);
        for (const Particle& particle : simulation.particles()) {
            lost += particle.position.allFinite() && particle.velocity.allFinite() ? 0 : 1;
            fastest = std::max(fastest, particle.velocity.norm());
            const double distance = start.collider.shape == ColliderShape::Mesh
                                        ? std::abs(particle.position.z()) - 0.1
                                        : make_solid(start.collider)->surface(particle.position).distance;
            off = std::max(off, std::abs(distance));
        }
    }
    expect_at_most("particles without a finite place and velocity", lost, 0);
    expect_at_most("distance from the surface", off, 1e-14);
    expect_at_most("speed given", fastest, 0);
}

// Self-gravity acts by kicks at the ends of a frame, but on what may hit something all through it.
TEST(RestUnderKicks, LastsOnATableAboveWhatAttracts)
{
    SimulationSettings settings = quiet_settings();
    settings.gravity.emplace();
    settings.background.max_cluster_size = 1; // what shares a cluster with the heavy one does not feel it
    settings.colliders = {with(box({0, 0, -0.25}, {2, 2, 0.25}), 0.8, 0.5)};
    ParticleSet particles = ball(64, 0.2, 0, 3, {0, 0, 0.5});
    for (Particle& particle : particles)
        particle.mass = 1e-9F;
    particles.push_back({{0, 0, -2}, {0, 0, 0}, 65, 4});
    Simulation simulation(settings, particles, {});
    run(simulation, 3000);
    const ParticleSet before = simulation.particles();
    run(simulation, 1000);
    const ParticleSet after = simulation.particles();
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_LE((after[i].position - before[i].position).norm(), 1e-6) << "particle " << i;
        EXPECT_NEAR(after[i].position.z(), 0, 1e-12) << "particle " << i;
        EXPECT_LE(after[i].velocity.norm(), 1e-6) << "particle " << i;
    }
}

} // namespace
} // namespace slod::test
