#include "support/leapfrog.hpp"

#include <algorithm>
#include <cmath>

#include "support/case_rows.hpp"

namespace slod::test {
namespace {

void kick(ParticleSet& particles, const SimulationSettings& settings, double step)
{
    for (Particle& target : particles) {
        Vector3d acceleration(0, 0, 0);
        for (const Particle& source : particles) {
            const Vector3d away = source.position - target.position;
            const double target_softening = settings.kinds[target.kind].softening;
            const double source_softening = settings.kinds[source.kind].softening;
            const double square = away.squaredNorm() + 0.5 * (target_softening * target_softening +
                                                              source_softening * source_softening);
            if (&source != &target && square > 0)
                acceleration += double(source.mass) / (square * std::sqrt(square)) * away;
        }
        target.velocity += step * acceleration;
    }
}

} // namespace

ParticleSet leapfrog(ParticleSet particles, const SimulationSettings& settings, int frames)
{
    const double step = settings.time.step;
    for (int frame = 0; frame < frames; ++frame) {
        kick(particles, settings, 0.5 * step);
        for (Particle& particle : particles)
            particle.position += step * particle.velocity;
        kick(particles, settings, 0.5 * step);
    }
    return particles;
}

double largest_distance(const ParticleSet& a, const ParticleSet& b)
{
    double largest = a.size() == b.size() ? 0 : INFINITY;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = worse(largest, (a[i].position - b[i].position).norm());
    return largest;
}

} // namespace slod::test
