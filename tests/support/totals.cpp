#include "support/totals.hpp"

#include <Eigen/Geometry>

namespace slod::test {
namespace {

using Wide = Eigen::Matrix<long double, 3, 1>;

struct Centre {
    long double mass = 0;
    Wide position = Wide::Zero(), velocity = Wide::Zero();
};

Centre centre_of(std::span<const Particle> particles)
{
    Centre centre;
    for (const Particle& particle : particles) {
        centre.mass += particle.mass;
        centre.position += static_cast<long double>(particle.mass) * particle.position.cast<long double>();
        centre.velocity += static_cast<long double>(particle.mass) * particle.velocity.cast<long double>();
    }
    centre.position /= centre.mass;
    centre.velocity /= centre.mass;
    return centre;
}

} // namespace

ConservedQuantities totals(std::span<const Particle> particles)
{
    long double mass = 0;
    long double energy = 0;
    Wide momentum = Wide::Zero();
    Wide angular = Wide::Zero();
    for (const Particle& particle : particles) {
        const long double m = particle.mass;
        const Wide x = particle.position.cast<long double>();
        const Wide v = particle.velocity.cast<long double>();
        mass += m;
        momentum += m * v;
        angular += m * x.cross(v);
        energy += m * v.squaredNorm() / 2;
    }
    return {double(mass), momentum.cast<double>(), angular.cast<double>(), double(energy)};
}

InternalMotion internal_motion(std::span<const Particle> particles)
{
    const Centre centre = centre_of(particles);
    long double energy = 0;
    long double angular = 0;
    for (const Particle& particle : particles) {
        const Wide dx = particle.position.cast<long double>() - centre.position;
        const Wide dv = particle.velocity.cast<long double>() - centre.velocity;
        energy += static_cast<long double>(particle.mass) * dv.squaredNorm() / 2;
        angular += static_cast<long double>(particle.mass) * dx.norm() * dv.norm();
    }
    return {double(energy), double(angular)};
}

} // namespace slod::test
