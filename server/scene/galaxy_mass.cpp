#include "scene/galaxy_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/portable_math.hpp"

namespace slod {
namespace {

constexpr std::size_t disc_intervals = 256;
constexpr std::size_t spheroid_intervals = 512;

double portable_tanh(double x)
{
    const double e = portable_expm1(-2 * x);
    return -e / (2 + e);
}

/// The mean of two positive numbers that Gauss found in elliptic integrals.
double arithmetic_geometric_mean(double a, double b)
{
    while (std::abs(a - b) > 1e-7 * a) { // the next step squares the difference
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return 0.5 * (a + b);
}

} // namespace

MassProfile::MassProfile(std::vector<double> radii, const std::function<double(double)>& mass_per_radius,
                         double mass)
    : radii_(std::move(radii)), inside_(radii_.size())
{
    for (std::size_t i = 1; i < radii_.size(); ++i) { // Simpson's rule
        const double a = radii_[i - 1], b = radii_[i];
        inside_[i] =
            inside_[i - 1] +
            (b - a) / 6 * (mass_per_radius(a) + 4 * mass_per_radius(0.5 * (a + b)) + mass_per_radius(b));
    }
    const double scale = mass / inside_.back();
    for (double& inside : inside_)
        inside *= scale;
}

double MassProfile::mass_inside(double radius) const
{
    if (radius >= radii_.back())
        return inside_.back();
    const std::size_t i =
        std::size_t(std::upper_bound(radii_.begin(), radii_.end(), radius) - radii_.begin());
    const double a = radii_[i - 1], b = radii_[i];
    const double part = (radius * radius - a * a) / (b * b - a * a);
    return inside_[i - 1] + part * (inside_[i] - inside_[i - 1]);
}

double MassProfile::radius_of(double share) const
{
    const double target = share * inside_.back();
    const auto above = std::upper_bound(inside_.begin() + 1, inside_.end() - 1, target);
    const std::size_t i = std::size_t(above - inside_.begin());
    // Mass grows with the square of the radius at the centre of a disc and of a 1/r cusp alike.
    const double a = radii_[i - 1], b = radii_[i];
    const double part = std::clamp((target - inside_[i - 1]) / (inside_[i] - inside_[i - 1]), 0.0, 1.0);
    return std::sqrt(a * a + part * (b * b - a * a));
}

std::vector<MassAtRadius> MassProfile::pieces() const
{
    std::vector<MassAtRadius> pieces;
    for (std::size_t i = 1; i < radii_.size(); ++i)
        pieces.push_back({0.5 * (radii_[i - 1] + radii_[i]), inside_[i] - inside_[i - 1]});
    return pieces;
}

double DiscShape::surface_density(double radius) const
{
    return mass / (2 * std::numbers::pi * scale_length * scale_length) * portable_exp(-radius / scale_length);
}

MassProfile disc_profile(const DiscShape& disc)
{
    std::vector<double> radii;
    for (std::size_t i = 0; i <= disc_intervals; ++i)
        radii.push_back(disc.outer_radius() * double(i) / disc_intervals);
    return MassProfile(
        std::move(radii), [&](double r) { return r * disc.surface_density(r); }, disc.mass);
}

std::vector<MassAtRadius> disc_shells(const DiscShape& disc, const MassProfile& profile)
{
    const auto rings = profile.pieces();
    std::vector<MassAtRadius> shells;
    double inside = 0;
    for (std::size_t i = 1; i <= disc_intervals; ++i) {
        const double radius = disc.outer_radius() * double(i) / disc_intervals;
        double within = 0;
        for (const MassAtRadius& ring : rings)
            if (ring.radius < radius)
                within += ring.mass * portable_tanh(std::sqrt(radius * radius - ring.radius * ring.radius) /
                                                    disc.scale_height);
        shells.push_back({disc.outer_radius() * (double(i) - 0.5) / disc_intervals, within - inside});
        inside = within;
    }
    return shells;
}

double SpheroidShape::relative_density(double radius) const
{
    const double rest = 1 - radius * radius / (cutoff * cutoff);
    const double reach = radius + scale_length;
    return radius < cutoff ? rest * rest / (radius * reach * reach * reach) : 0;
}

MassProfile spheroid_profile(const SpheroidShape& spheroid)
{
    // Equal steps of r / (r + scale) resolve the cusp and the far end alike.
    std::vector<double> radii;
    for (std::size_t i = 0; i <= spheroid_intervals; ++i) {
        const double s =
            spheroid.cutoff / (spheroid.cutoff + spheroid.scale_length) * double(i) / spheroid_intervals;
        radii.push_back(i == spheroid_intervals ? spheroid.cutoff : spheroid.scale_length * s / (1 - s));
    }
    const auto mass_per_radius = [&](double r) { return r > 0 ? r * r * spheroid.relative_density(r) : 0; };
    return MassProfile(std::move(radii), mass_per_radius, spheroid.mass);
}

double shell_potential(std::span<const MassAtRadius> shells, double radius, double softening_squared)
{
    // The mean of 1 / distance over a sphere is that over its nearest and farthest distance.
    double sum = 0;
    for (const MassAtRadius& shell : shells) {
        const double far = radius + shell.radius, near = radius - shell.radius;
        sum += shell.mass /
               (std::sqrt(far * far + softening_squared) + std::sqrt(near * near + softening_squared));
    }
    return -2 * sum;
}

double ring_potential(std::span<const MassAtRadius> rings, double radius, double height_squared)
{
    // A circle has the arithmetic-geometric mean of both distances, where a sphere has the arithmetic one.
    double sum = 0;
    for (const MassAtRadius& ring : rings) {
        const double far = radius + ring.radius, near = radius - ring.radius;
        sum += ring.mass / arithmetic_geometric_mean(std::sqrt(far * far + height_squared),
                                                     std::sqrt(near * near + height_squared));
    }
    return -sum;
}

} // namespace slod
