#include "scene/galaxy_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/portable_math.hpp"

namespace slod {

namespace {

/// A set of particles seen as one body.
struct Body {
    double mass = 0;
    Vector3d position{0, 0, 0};
    Vector3d velocity{0, 0, 0};
};

Body body_of(const ParticleSet& particles)
{
    Body body;
    for (const Particle& particle : particles) {
        const double mass = double(particle.mass);
        body.mass += mass;
        body.position += mass * particle.position;
        body.velocity += mass * particle.velocity;
    }
    body.position /= body.mass;
    body.velocity /= body.mass;
    return body;
}

/// Puts the set's centre of mass at `position`, moving with `velocity`. The second pass takes away what the
/// rounding of large shifts leaves in the first.
void place(ParticleSet& particles, const Vector3d& position, const Vector3d& velocity)
{
    for (int pass = 0; pass < 2; ++pass) {
        const Body body = body_of(particles);
        for (Particle& particle : particles) {
            particle.position += position - body.position;
            particle.velocity += velocity - body.velocity;
        }
    }
}

/// Turns the set about the x axis, from y to z.
void tilt(ParticleSet& particles, double angle_deg)
{
    const SineCosine turn = portable_sincos(angle_deg * (std::numbers::pi / 180));
    Matrix3d rotation;
    rotation << 1, 0, 0, 0, turn.cosine, -turn.sine, 0, turn.sine, turn.cosine;
    for (Particle& particle : particles) {
        particle.position = rotation * particle.position;
        particle.velocity = rotation * particle.velocity;
    }
}

void append_with_new_ids(ParticleSet& all, const ParticleSet& more)
{
    std::uint64_t next = 0;
    for (const Particle& particle : all)
        next = std::max(next, particle.id + 1);
    all.reserve(all.size() + more.size());
    for (const Particle& particle : more) {
        all.push_back(particle);
        all.back().id += next;
    }
}

} // namespace

ParticleSet on_parabolic_orbit(ParticleSet first, ParticleSet second, const EncounterSettings& encounter,
                               double gravitational_constant)
{
    const double mass = body_of(first).mass + body_of(second).mass;
    const double share_of_first = body_of(first).mass / mass;
    // On a parabola of pericentre q: v^2 = 2 G M / d and h^2 = 2 G M q at any distance d.
    const double distance = encounter.separation;
    const double closeness = encounter.pericentre / distance;
    const double speed = std::sqrt(2 * gravitational_constant * mass / distance);
    const Vector3d apart{distance, 0, 0};
    const Vector3d approach{-speed * std::sqrt(1 - closeness), speed * std::sqrt(closeness), 0};

    place(second, {0, 0, 0}, {0, 0, 0});
    tilt(second, encounter.inclination_deg);
    place(first, (share_of_first - 1) * apart, (share_of_first - 1) * approach);
    place(second, share_of_first * apart, share_of_first * approach);
    append_with_new_ids(first, second);
    place(first, {0, 0, 0}, {0, 0, 0});
    return first;
}

} // namespace slod
