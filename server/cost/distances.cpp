#include "cost/distances.hpp"

#include <algorithm>

#include "core/random.hpp"

namespace slod::cost {
namespace {

double over(double distance, double floor)
{
    return distance == 0 ? 0 : distance / floor;
}

} // namespace

Cloud::Cloud(ParticleSet set) : particles(std::move(set)), x(positions(particles)), v(velocities(particles))
{}

double Distances::largest() const
{
    return std::max({position, velocity, coarse, fine});
}

Distances& Distances::operator+=(const Distances& other)
{
    position += other.position;
    velocity += other.velocity;
    coarse += other.coarse;
    fine += other.fine;
    return *this;
}

Distances operator/(const Distances& d, double divisor)
{
    return {d.position / divisor, d.velocity / divisor, d.coarse / divisor, d.fine / divisor};
}

Distances distances(const Cloud& a, const Cloud& b, double radius)
{
    return {.position = sliced_wasserstein(a.x, b.x),
            .velocity = sliced_wasserstein(a.v, b.v),
            .coarse = density_distance(a.x, b.x, radius / 4),
            .fine = density_distance(a.x, b.x, radius / 16)};
}

Distances in_floors(const Distances& apart, const Distances& floor)
{
    return {.position = over(apart.position, floor.position),
            .velocity = over(apart.velocity, floor.velocity),
            .coarse = over(apart.coarse, floor.coarse),
            .fine = over(apart.fine, floor.fine)};
}

ParticleSet resample(const ParticleSet& particles, std::uint32_t draw)
{
    ParticleSet sample;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        Random random(1, draw, i);
        sample.push_back(particles[std::size_t(random.uniform() * double(particles.size()))]);
    }
    return sample;
}

} // namespace slod::cost
