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
    return std::max({position, velocity, energy, coarse, fine});
}

Distances& Distances::operator+=(const Distances& other)
{
    for (const DistanceMember& member : distance_members)
        this->*member.value += other.*member.value;
    return *this;
}

Distances operator/(const Distances& distances, double divisor)
{
    Distances quotient;
    for (const DistanceMember& member : distance_members)
        quotient.*member.value = distances.*member.value / divisor;
    return quotient;
}

Distances distances(const Cloud& reference, const Cloud& other, double radius)
{
    const ProfileDistances profiles = profile_distances(reference.x, reference.v, other.x, other.v);
    return {.position = sliced_wasserstein(reference.x, other.x),
            .velocity = sliced_wasserstein(reference.v, other.v),
            .energy = energy_distance(reference.x, other.x),
            .coarse = density_distance(reference.x, other.x, radius / 4),
            .fine = density_distance(reference.x, other.x, radius / 16),
            .profile = profiles.density,
            .dispersion = profiles.dispersion};
}

Distances in_floors(const Distances& apart, const Distances& floor)
{
    Distances errors;
    for (const DistanceMember& member : distance_members)
        errors.*member.value = over(apart.*member.value, floor.*member.value);
    return errors;
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
