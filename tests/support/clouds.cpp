#include "support/clouds.hpp"

#include <cmath>
#include <numbers>

#include "support/random_draws.hpp"

namespace slod::test {

Vector3d point_in_ball(Random& random, double radius)
{
    for (;;) {
        const double x = 2 * random.uniform() - 1;
        const double y = 2 * random.uniform() - 1;
        const double z = 2 * random.uniform() - 1;
        if (const Vector3d point{x, y, z}; point.squaredNorm() <= 1)
            return radius * point;
    }
}

ParticleSet ball(std::size_t count, double radius, double speed, std::uint64_t seed, const Vector3d& centre)
{
    ParticleSet particles(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(seed, 0, i);
        particles[i].position = centre + point_in_ball(random, radius);
        particles[i].velocity = point_in_ball(random, speed);
        particles[i].id = i + 1;
        particles[i].mass = 1;
    }
    return particles;
}

ParticleSet cube(std::size_t count, double half_side, std::uint64_t seed, const Vector3d& centre)
{
    ParticleSet particles(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(seed, 4, i);
        for (int axis = 0; axis < 3; ++axis)
            particles[i].position[axis] = centre[axis] + half_side * (2 * random.uniform() - 1);
        particles[i].velocity.setZero();
        particles[i].id = i + 1;
        particles[i].mass = 1;
    }
    return particles;
}

ParticleSet plummer_sphere(std::size_t count, std::uint64_t seed)
{
    ParticleSet particles(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(seed, 0, i);
        double radius = 0;
        do // Aarseth, Henon and Wielen 1974, A&A 37, 183: the mass within r is r^3 / (1 + r^2)^(3/2)
            radius = 1 / std::sqrt(std::pow(random.uniform(), -2.0 / 3.0) - 1);
        while (radius > 10);
        const double dispersion = std::sqrt(1 / (6 * std::sqrt(1 + radius * radius)));
        particles[i].position = radius * random_direction(random);
        const double vx = random_normal(random);
        const double vy = random_normal(random);
        particles[i].velocity = dispersion * Vector3d(vx, vy, random_normal(random));
        particles[i].id = i + 1;
        particles[i].mass = 1 / float(count);
    }
    return particles;
}

ParticleSet cloud(std::size_t count, std::uint64_t seed, const std::function<Vector3d(Random&)>& place)
{
    ParticleSet particles(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(seed, 0, i);
        particles[i].position = place(random);
        particles[i].velocity.setZero();
        particles[i].id = i + 1;
        particles[i].mass = 1 / float(count);
    }
    return particles;
}

Vector3d in_unit_box(Random& random)
{
    const double x = random.uniform(), y = random.uniform();
    return {x, y, random.uniform()};
}

Vector3d in_exponential_disc(Random& random)
{
    const double radius = -std::log(random.uniform() * random.uniform());
    const double angle = 2 * std::numbers::pi * random.uniform();
    return {radius * std::cos(angle), radius * std::sin(angle), 0.05 * random_normal(random)};
}

ParticleSet two_clumps(std::size_t count, std::uint64_t seed)
{
    std::uint64_t index = 0;
    return cloud(count, seed, [&](Random& random) {
        const double x = random_normal(random), y = random_normal(random);
        const Vector3d offset = 0.02 * Vector3d(x, y, random_normal(random));
        return Vector3d(offset + double(index++ % 2) * Vector3d(10.1, 9.9, 10));
    });
}

ParticleSet mass_spectrum(std::size_t count, std::uint64_t seed)
{
    ParticleSet particles = plummer_sphere(count, seed);
    for (Particle& particle : particles)
        particle.mass = float(std::pow(10.0, -6 * Random(seed, 1, particle.id).uniform()));
    return particles;
}

void give_masses(ParticleSet& particles, double lowest, double highest, std::uint64_t seed)
{
    for (Particle& particle : particles)
        particle.mass = float(lowest + (highest - lowest) * Random(seed, 1, particle.id).uniform());
}

} // namespace slod::test
