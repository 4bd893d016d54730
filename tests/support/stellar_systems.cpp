#include "support/stellar_systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/clouds.hpp"
#include "support/disc_measures.hpp"
#include "support/random_draws.hpp"
#include "support/totals.hpp"

namespace slod::test {
namespace {

/// Speed over that of escape: q^2 (1 - q^2)^(7/2), by rejection (Aarseth, Henon and Wielen 1974, A&A 37,
/// 183).
double share_of_escape_speed(Random& random)
{
    for (;;) {
        const double q = random.uniform();
        if (0.1 * random.uniform() < q * q * std::pow(1 - q * q, 3.5))
            return q;
    }
}

/// The mean place of the nearest half, thrice: of the core, whatever flies about outside.
Vector3d densest_place(std::span<const Particle> particles)
{
    Vector3d centre{0, 0, 0};
    std::vector<Vector3d> places;
    for (const Particle& particle : particles) {
        places.push_back(particle.position);
        centre += particle.position / double(particles.size());
    }
    for (int round = 0; round < 3; ++round) {
        const auto half = places.begin() + std::ptrdiff_t(places.size() / 2);
        std::nth_element(places.begin(), half, places.end(), [&](const Vector3d& a, const Vector3d& b) {
            return (a - centre).squaredNorm() < (b - centre).squaredNorm();
        });
        Vector3d sum{0, 0, 0};
        for (auto place = places.begin(); place != half; ++place)
            sum += *place;
        centre = sum / double(half - places.begin());
    }
    return centre;
}

CaseCurve curve_of(const SystemHistory& history, double SystemMeasures::*measure, const std::string& name)
{
    CaseCurve curve{history.name + name, history.times, {}};
    for (const SystemMeasures& look : history.looks)
        curve.y.push_back(look.*measure);
    return curve;
}

} // namespace

ParticleSet plummer_in_equilibrium(std::size_t count, std::uint64_t seed)
{
    constexpr double scale = 3 * std::numbers::pi / 16;
    ParticleSet particles = plummer_sphere(count, seed);
    Vector3d place{0, 0, 0}, velocity{0, 0, 0};
    for (std::size_t i = 0; i < count; ++i) {
        Particle& particle = particles[i];
        Random random(seed, 1, i);
        const double escape = std::sqrt(2 / std::sqrt(1 + particle.position.squaredNorm()));
        const double speed = escape * share_of_escape_speed(random);
        particle.velocity = speed / std::sqrt(scale) * random_direction(random);
        particle.position *= scale;
        place += particle.position / double(count);
        velocity += particle.velocity / double(count);
    }
    for (Particle& particle : particles) {
        particle.position -= place;
        particle.velocity -= velocity;
    }
    return particles;
}

ParticleSet figure_eight()
{
    const Vector3d place(0.97000436, -0.24308753, 0), velocity(-0.93240737, -0.86473146, 0);
    return {{place, -0.5 * velocity, 1, 1}, {-place, -0.5 * velocity, 2, 1}, {{0, 0, 0}, velocity, 3, 1}};
}

SystemMeasures measure_system(std::span<const Particle> particles, double softening)
{
    const Vector3d centre = densest_place(particles);
    std::vector<double> radii;
    for (const Particle& particle : particles)
        radii.push_back((particle.position - centre).norm());
    std::sort(radii.begin(), radii.end());
    const ConservedQuantities sums = totals(particles);
    SystemMeasures measures;
    measures.r10 = radii[radii.size() / 10];
    measures.r50 = radii[radii.size() / 2];
    measures.r90 = radii[radii.size() * 9 / 10];
    measures.energy = total_energy(particles, 1, softening);
    measures.virial_ratio = 2 * sums.kinetic_energy / (sums.kinetic_energy - measures.energy);
    measures.momentum = sums.momentum;
    return measures;
}

double SystemHistory::largest_change(double SystemMeasures::*measure) const
{
    double largest = 0;
    for (const SystemMeasures& look : looks)
        largest = std::max(largest, std::abs(look.*measure / (looks.front().*measure) - 1));
    return largest;
}

double SystemHistory::change_at_the_end(double SystemMeasures::*measure) const
{
    return looks.back().*measure / (looks.front().*measure) - 1;
}

void report_history(const std::string& title, std::span<const SystemHistory> histories)
{
    CasePicture radii{title, "time, G = M = 1, E = -1/4", "radius of 10, 50 and 90 % of the stars", {}, false,
                      true};
    CasePicture energy{title, "time, G = M = 1, E = -1/4", "relative error of the energy", {}};
    for (const SystemHistory& history : histories) {
        radii.curves.push_back(curve_of(history, &SystemMeasures::r10, ", 10 %"));
        radii.curves.push_back(curve_of(history, &SystemMeasures::r50, ", 50 %"));
        radii.curves.push_back(curve_of(history, &SystemMeasures::r90, ", 90 %"));
        energy.curves.push_back(curve_of(history, &SystemMeasures::energy, ""));
        for (double& value : energy.curves.back().y)
            value = value / history.looks.front().energy - 1;
    }
    report_picture(radii);
    report_picture(energy);
}

} // namespace slod::test
