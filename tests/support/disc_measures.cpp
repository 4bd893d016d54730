#include "support/disc_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

#include "core/parallel.hpp"

namespace slod::test {
namespace {

struct Frame {
    Vector3d position{0, 0, 0}, velocity{0, 0, 0};
    double count = 0;
};

Frame centre(std::span<const Particle> particles, std::uint8_t kind)
{
    Frame sum;
    for (const Particle& particle : particles) {
        if (particle.kind != kind)
            continue;
        sum.position += particle.position;
        sum.velocity += particle.velocity;
        ++sum.count;
    }
    return {sum.position / sum.count, sum.velocity / sum.count, sum.count};
}

double quantile(std::vector<double>& values, double share)
{
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size()));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace

Vector3d disc_axis(std::span<const Particle> particles, std::uint8_t kind)
{
    const Frame frame = centre(particles, kind);
    Vector3d spin{0, 0, 0};
    for (const Particle& particle : particles)
        if (particle.kind == kind)
            spin += (particle.position - frame.position).cross(particle.velocity - frame.velocity);
    return spin.normalized();
}

DiscMeasures measure_disc(std::span<const Particle> particles, std::uint8_t kind, const Vector3d& axis)
{
    const Frame frame = centre(particles, kind);
    std::vector<double> radii;
    double height_squared = 0, radial = 0, radial_squared = 0, spin = 0;
    for (const Particle& particle : particles) {
        if (particle.kind != kind)
            continue;
        const Vector3d x = particle.position - frame.position;
        const Vector3d v = particle.velocity - frame.velocity;
        const double height = x.dot(axis);
        const Vector3d in_plane = x - height * axis;
        const double speed_out = v.dot(in_plane.normalized());
        radii.push_back(in_plane.norm());
        height_squared += height * height;
        radial += speed_out;
        radial_squared += speed_out * speed_out;
        spin += x.cross(v).dot(axis);
    }
    const double n = frame.count;
    DiscMeasures disc;
    disc.r10 = quantile(radii, 0.1);
    disc.r50 = quantile(radii, 0.5);
    disc.thickness = std::sqrt(height_squared / n);
    disc.radial_dispersion = std::sqrt(radial_squared / n - radial * radial / (n * n));
    disc.spin = spin / n;
    return disc;
}

double median_distance(std::span<const Particle> a, std::span<const Particle> b, std::uint8_t kind)
{
    std::vector<double> distances;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].kind == kind)
            distances.push_back((a[i].position - b[i].position).norm());
    return quantile(distances, 0.5);
}

double total_energy(std::span<const Particle> particles, double gravitational_constant, double softening)
{
    std::vector<double> energies(particles.size());
    for_each_block(particles.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            double potential = 0;
            for (std::size_t j = i + 1; j < particles.size(); ++j) {
                const double squared = (particles[i].position - particles[j].position).squaredNorm();
                potential -= double(particles[j].mass) / std::sqrt(squared + softening * softening);
            }
            energies[i] = double(particles[i].mass) *
                          (0.5 * particles[i].velocity.squaredNorm() + gravitational_constant * potential);
        }
    });
    return std::accumulate(energies.begin(), energies.end(), 0.0);
}

} // namespace slod::test
