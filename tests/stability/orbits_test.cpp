#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/small_scenes.hpp"

// Two bodies, whose orbits are known: as single particles, and with one of them made of 64 coincident
// particles in one cluster, which have to move as the one.
namespace slod::test {
namespace {

using std::numbers::pi;

/// What the lighter body is made of, and how its cluster moves.
struct Making {
    const char* name;
    std::uint32_t members = 1;
    Motion motion = Motion::Flow;

    friend std::ostream& operator<<(std::ostream& out, const Making& making) { return out << making.name; }
};

struct Orbit {
    double primary_mass = 0.75, companion_mass = 0.25;
    Vector3d separation{1, 0, 0}, velocity{0, 1, 0}; ///< of the companion from the primary
    double softening = 0;
    double step = 0;
    Precision precision = Precision::Double;
};

/// The two bodies in a simulation, their common centre at rest: at the origin, or, as a cluster that leaves
/// its cell is formed anew member by member, in the middle of one. All is seen from there.
class TwoBodies {
public:
    TwoBodies(const Orbit& orbit, const Making& making)
        : orbit_(orbit), centre_(centre_of(making)),
          simulation_(settings_of(orbit, making), particles_of(orbit, making), {})
    {
        look();
    }

    void step()
    {
        clusters_ = std::max(clusters_, simulation_.step({}).counts.clusters);
        look();
    }

    const Vector3d& primary() const { return position_[0]; }
    const Vector3d& companion() const { return position_[1]; }
    Vector3d separation() const { return position_[1] - position_[0]; }

    double energy() const
    {
        const double distance = std::sqrt(separation().squaredNorm() + orbit_.softening * orbit_.softening);
        return kinetic_energy() - G_ * orbit_.primary_mass * orbit_.companion_mass / distance;
    }
    double kinetic_energy() const
    {
        return 0.5 * (orbit_.primary_mass * velocity_[0].squaredNorm() +
                      orbit_.companion_mass * velocity_[1].squaredNorm());
    }
    Vector3d momentum() const
    {
        return orbit_.primary_mass * velocity_[0] + orbit_.companion_mass * velocity_[1];
    }
    Vector3d angular_momentum() const
    {
        return orbit_.primary_mass * position_[0].cross(velocity_[0]) +
               orbit_.companion_mass * position_[1].cross(velocity_[1]);
    }
    /// Largest distance of one of the companion's particles from the first of them.
    double spread() const { return spread_; }
    std::uint64_t clusters() const { return clusters_; } ///< at most, in any frame

private:
    /// Particles of unlike mass share no cluster, wherever they are.
    static SimulationSettings settings_of(const Orbit& orbit, const Making& making)
    {
        SimulationSettings settings = quiet_settings();
        settings.time.step = orbit.step;
        settings.kinds.front().softening = orbit.softening;
        settings.gravity.emplace();
        settings.gravity->precision = orbit.precision;
        settings.motion.motion = making.motion;
        // Clusters that take strays are formed with room for them.
        settings.background.max_cluster_size = making.members > 1 ? 2 * making.members : 1;
        settings.background.max_breadth = making.members > 1 ? 8 : INFINITY; // and side of a cell
        settings.background.bin_by = BinBy::Mass;
        settings.background.bin_floor = 0.5 * orbit.primary_mass;
        return settings;
    }

    static Vector3d centre_of(const Making& making) { return Vector3d::Constant(making.members > 1 ? 4 : 0); }

    static ParticleSet particles_of(const Orbit& orbit, const Making& making)
    {
        const double mass = orbit.primary_mass + orbit.companion_mass;
        const double primary_share = -orbit.companion_mass / mass;
        const double companion_share = orbit.primary_mass / mass;
        ParticleSet particles{
            {primary_share * orbit.separation, primary_share * orbit.velocity, 0, float(orbit.primary_mass)}};
        for (std::uint32_t i = 1; i <= making.members; ++i)
            particles.push_back({companion_share * orbit.separation, companion_share * orbit.velocity, i,
                                 float(orbit.companion_mass / making.members)});
        for (Particle& particle : particles)
            particle.position += centre_of(making);
        return particles;
    }

    void look()
    {
        const ParticleSet particles = simulation_.particles();
        position_[0] = particles[0].position - centre_;
        velocity_[0] = particles[0].velocity;
        position_[1].setZero();
        velocity_[1].setZero();
        const double share = 1 / double(particles.size() - 1);
        for (std::size_t i = 1; i < particles.size(); ++i) {
            position_[1] += share * (particles[i].position - centre_);
            velocity_[1] += share * particles[i].velocity;
            spread_ = std::max(spread_, (particles[i].position - particles[1].position).norm());
        }
    }

    double G_ = quiet_settings().units.gravitational_constant();
    Orbit orbit_;
    Vector3d centre_;
    Simulation simulation_;
    Vector3d position_[2], velocity_[2];
    double spread_ = 0;
    std::uint64_t clusters_ = 0;
};

class KeplerOrbit : public testing::TestWithParam<Making> {};

INSTANTIATE_TEST_SUITE_P(Of, KeplerOrbit,
                         testing::Values(Making{"two_particles"}, Making{"a_cluster_that_flows", 64},
                                         Making{"a_rigid_cluster", 64, Motion::Rigid}),
                         [](const auto& tested) { return std::string(tested.param.name); });

/// The semi-major axis is 1, the start farthest out, the turn 2 pi, divided into so many steps.
Orbit eccentric(double eccentricity, double steps_per_turn)
{
    Orbit orbit;
    orbit.separation = {1 + eccentricity, 0, 0};
    orbit.velocity = {0, std::sqrt((1 - eccentricity) / (1 + eccentricity)), 0};
    orbit.step = 2 * pi / steps_per_turn;
    return orbit;
}

// A leapfrog conserves an energy that differs from the true one by terms of (2 pi / 100)^2 times the
// eccentricity that this itself makes: (2 pi / 100)^4 / 4 = 3.9e-6. Angular momentum is changed by rounding.
TEST_P(KeplerOrbit, G01_KeepsItsEnergyForAThousandTurns)
{
    constexpr int turns = 1000, steps = 100;
    TwoBodies bodies(eccentric(0, steps), GetParam());
    const double energy = bodies.energy();
    const Vector3d spin = bodies.angular_momentum();
    double energy_error = 0, spin_error = 0;
    CaseCurve curve{GetParam().name, {}, {}};
    for (int turn = 1; turn <= turns; ++turn) {
        for (int step = 0; step < steps; ++step) {
            bodies.step();
            energy_error = std::max(energy_error, std::abs(bodies.energy() / energy - 1));
            spin_error = std::max(spin_error, (bodies.angular_momentum() - spin).norm() / spin.norm());
        }
        curve.x.push_back(turn);
        curve.y.push_back(bodies.energy() / energy - 1);
    }
    expect_at_most("largest error of the energy", energy_error, 1e-5);
    expect_at_most("largest error of the angular momentum", spin_error, 1e-12);
    expect_at_most("largest distance between the companion's particles", bodies.spread(), 1e-12);
    expect_at_most("most clusters in a frame", double(bodies.clusters()), 2);
    report_picture({"Circular orbit of 100 steps", "turns", "relative error of the energy", {curve}});
}

/// Largest relative error of the energy on one turn.
double largest_energy_error(const Orbit& orbit, int steps, const Making& making)
{
    TwoBodies bodies(orbit, making);
    const double energy = bodies.energy();
    double error = 0;
    for (int step = 0; step < steps; ++step) {
        bodies.step();
        error = std::max(error, std::abs(bodies.energy() / energy - 1));
    }
    return error;
}

TEST_P(KeplerOrbit, G02_OfHighEccentricityIsFollowedToSecondOrder)
{
    const auto error = [&](int steps) {
        return largest_energy_error(eccentric(0.9, steps), steps, GetParam());
    };
    const double coarse = error(1'000), middle = error(10'000), fine = error(100'000);
    expect_within("order, from 1,000 to 10,000 steps a turn", std::log10(coarse / middle), 1.9, 2.1);
    expect_within("order, from 10,000 to 100,000 steps a turn", std::log10(middle / fine), 1.9, 2.1);
    expect_at_most("largest error of the energy at 10,000 steps a turn", middle, 1.5e-3);
    report_picture({"Orbit of eccentricity 0.9",
                    "steps a turn",
                    "largest relative error of the energy",
                    {{GetParam().name, {1e3, 1e4, 1e5}, {coarse, middle, fine}}},
                    true,
                    true});
}

// What the pericentres cost comes back on the way out.
TEST(KeplerOrbitOfHighEccentricity, G02_HasNoDriftOverAHundredTurns)
{
    constexpr int turns = 100, steps = 10'000;
    TwoBodies bodies(eccentric(0.9, steps), {"two_particles"});
    const double energy = bodies.energy();
    CaseCurve curve{"two particles", {}, {}};
    for (int turn = 1; turn <= turns; ++turn) {
        for (int step = 0; step < steps; ++step)
            bodies.step();
        curve.x.push_back(turn);
        curve.y.push_back(std::abs(bodies.energy() / energy - 1));
    }
    expect_at_most("error of the energy after a hundred turns", curve.y.back(), 1e-8);
    report_picture({"Orbit of eccentricity 0.9, 10,000 steps a turn",
                    "turns",
                    "relative error of the energy, farthest out",
                    {curve}});
}

// One step from the pericentre at 1e5 times the speed of a circular orbit: the way along the track is that of
// a free body but for 1 / v^2 = 1e-10 (the energy, over the speed), which the half kick across it cannot see.
TEST_P(KeplerOrbit, G04_AVeryHyperbolicFlybyIsAStraightLine)
{
    Orbit orbit;
    orbit.velocity = {0, 1e5, 0};
    orbit.step = 1.234;
    TwoBodies bodies(orbit, GetParam());
    bodies.step();
    const double along = orbit.velocity.y() * orbit.step;
    expect_at_most("relative error of the way", std::abs(bodies.separation().y() / along - 1), 1e-10);
    expect_at_most("error of the momentum, of the companion's",
                   bodies.momentum().norm() / (orbit.companion_mass * orbit.velocity.norm()), 1e-15);
}

// The start is at ten softening lengths. In the core, of frequency 0.1^(-3/2) = omega, a leapfrog's error
// oscillates by (omega step)^2 / 8 of the kinetic energy, ten times the total one: with omega step = 0.02 by
// 5e-4. Angular momentum is that of the rounding of a place.
TEST_P(KeplerOrbit, G05_ARadialPlungeComesBackAHundredTimes)
{
    Orbit orbit;
    orbit.separation = Vector3d(1, 2, 2) / 3;
    orbit.velocity.setZero();
    orbit.softening = 0.1;
    orbit.step = 0.02 * std::pow(orbit.softening, 1.5);
    TwoBodies bodies(orbit, GetParam());
    const double energy = bodies.energy();
    const Vector3d axis = orbit.separation;
    double worst = 0, spin = 0, largest = 0, smallest = 2, before_last = 1, last = 1;
    int passages = 0, turns = 0;
    for (int step = 0; step < 500'000 && turns < 100; ++step) {
        const double old_place = bodies.separation().dot(axis);
        bodies.step();
        const double place = bodies.separation().dot(axis), distance = bodies.separation().norm();
        worst = std::max(worst, std::abs(bodies.energy() / energy - 1));
        spin = std::max(spin, bodies.angular_momentum().norm());
        passages += (place > 0) != (old_place > 0) ? 1 : 0;
        if (last > before_last && last >= distance && last > 0.5) {
            ++turns;
            largest = std::max(largest, last);
            smallest = std::min(smallest, last);
        }
        before_last = last;
        last = distance;
    }
    expect_within("passages", passages, 100, 100);
    expect_at_most("largest error of the energy", worst, 1e-3);
    expect_at_least("nearest return, of the start", smallest, 0.99);
    expect_at_most("farthest return, of the start", largest, 1.01);
    expect_at_most("angular momentum", spin, 1e-12);
}

// The heavy body's share of everything is 1e-12, and as precise as the light one's; its place is where that
// is not rounded, at the origin.
TEST_P(KeplerOrbit, G21_OfAMassRatioOfATrillionMovesBothBodies)
{
    constexpr int turns = 10, steps = 100;
    Orbit orbit = eccentric(0, steps);
    orbit.primary_mass = 1;
    orbit.companion_mass = float(1e-12);
    TwoBodies bodies(orbit, GetParam());
    const double energy = bodies.energy(), ratio = orbit.companion_mass;
    const double size = orbit.companion_mass; // of the companion's momentum, at speed 1
    double energy_error = 0, momentum = 0, lever = 0;
    for (int step = 0; step < turns * steps; ++step) {
        bodies.step();
        energy_error = std::max(energy_error, std::abs(bodies.energy() / energy - 1));
        momentum = std::max(momentum, bodies.momentum().norm() / size);
        lever = std::max(lever, (bodies.primary() + ratio * bodies.companion()).norm() / ratio);
    }
    expect_at_most("error of the momentum, of the light body's", momentum, 1e-12);
    if (GetParam().members == 1)
        expect_at_most("error of the heavy body's place, of its orbit's radius", lever, 1e-12);
    expect_at_most("largest error of the light body's energy", energy_error, 1e-5);
}

} // namespace
} // namespace slod::test
