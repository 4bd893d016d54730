#include "cost/drifts.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "gravity/potential.hpp"
#include "sim/plan.hpp"

namespace slod::cost {
namespace {

double potential(const ParticleSet& particles, const SimulationSettings& settings)
{
    if (!settings.gravity)
        return 0;
    if (particles.size() > most_energetic)
        return std::numeric_limits<double>::quiet_NaN();
    ForceView bodies; // as pairs without a tree
    for (const Particle& particle : particles) {
        const double softening = settings.kinds[particle.kind].softening;
        bodies.x.push_back(particle.position.x());
        bodies.y.push_back(particle.position.y());
        bodies.z.push_back(particle.position.z());
        bodies.mass.push_back(particle.mass);
        bodies.q.push_back(0.5 * softening * softening);
        bodies.slot.push_back({std::uint32_t(bodies.slot.size())});
    }
    return potential_energy(bodies, simd::kernels(),
                            settings.units.gravitational_constant() * settings.gravity->strength);
}

} // namespace

Totals totals(const ParticleSet& particles, const SimulationSettings& settings)
{
    Totals sum;
    for (const Particle& particle : particles) {
        const double mass = particle.mass;
        const Vector3d momentum = mass * particle.velocity;
        sum.mass += mass;
        sum.momentum += momentum;
        sum.angular_momentum += particle.position.cross(momentum);
        sum.second_moment += mass * particle.position.squaredNorm();
        sum.kinetic_energy += 0.5 * momentum.dot(particle.velocity);
    }
    sum.potential_energy = potential(particles, settings);
    return sum;
}

bool is_isolated(const SimulationSettings& settings, const ParticleSet& initial)
{
    const Plan plan = compile_plan(settings, initial);
    return std::all_of(plan.effects.begin(), plan.effects.end(), [](const PlannedEffect& effect) {
        return !effect.active || effect.name == "gravity";
    });
}

/// The largest momenta there could be are by Cauchy's inequality: (sum m v)^2 <= sum m sum m v^2, and
/// (sum m r v)^2 <= sum m r^2 sum m v^2.
Drifts drifts(const Totals& start, const Totals& end)
{
    Drifts changes;
    const double motion = 2 * end.kinetic_energy;
    if (motion > 0) {
        changes.momentum = (end.momentum - start.momentum).norm() / std::sqrt(end.mass * motion);
        if (end.second_moment > 0)
            changes.angular_momentum = (end.angular_momentum - start.angular_momentum).norm() /
                                       std::sqrt(end.second_moment * motion);
    }
    const double before = start.kinetic_energy + start.potential_energy;
    const double after = end.kinetic_energy + end.potential_energy;
    if (before != 0)
        changes.energy = (after - before) / std::abs(before);
    return changes;
}

} // namespace slod::cost
