#include "scene/galaxy_disc_orbits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/portable_math.hpp"

namespace slod {

namespace {

constexpr std::size_t last = DiscField::radius_steps;
constexpr int corrections = 20; ///< leave less than 0.1 % of error within six scale lengths

using Column = std::vector<double>; ///< by radius, one more than there are steps

double interpolate(const Column& column, double index)
{
    const std::size_t i = std::min(std::size_t(index), last - 1);
    return column[i] + (index - double(i)) * (column[i + 1] - column[i]);
}

/// R d/dR. Radii are quadratic in the index, so it is half the index times the derivative by the index.
Column log_slope(const Column& column)
{
    Column slope(last + 1);
    for (std::size_t i = 1; i <= last; ++i) {
        const std::size_t inner = std::min(i - 1, last - 2), outer = inner + 2;
        slope[i] = 0.25 * double(i) * (column[outer] - column[inner]);
    }
    return slope;
}

/// Circular orbits in the field, averaged over the disc's layers.
struct Rotation {
    Column potential;
    Column speed_squared;
    Column epicycle_squared; ///< (epicyclic frequency / twice the angular frequency)^2
    Column angular_momentum;
};

Rotation rotation_of(const DiscField& field)
{
    Rotation rotation;
    for (std::size_t i = 0; i <= last; ++i) {
        double sum = 0, weights = 0;
        for (std::size_t j = 0; j <= DiscField::height_steps; ++j) {
            const double weight = (j == 0 ? 0.5 : 1) * field.relative_density(j);
            sum += weight * field.potential(i, j);
            weights += weight;
        }
        rotation.potential.push_back(sum / weights);
    }
    rotation.speed_squared = log_slope(rotation.potential);
    const Column speed_slope = log_slope(rotation.speed_squared);
    for (std::size_t i = 0; i <= last; ++i) {
        // Between Kepler's orbits and those in a homogeneous ball; rounding may trespass at the centre.
        const double epicycle = i == 0 ? 1 : 0.5 + 0.25 * speed_slope[i] / rotation.speed_squared[i];
        rotation.epicycle_squared.push_back(std::clamp(epicycle, 0.25, 1.0));
        rotation.angular_momentum.push_back(field.radius(double(i)) * std::sqrt(rotation.speed_squared[i]));
    }
    return rotation;
}

/// Squared radial dispersions wanted, by radius.
Column wanted_radial_squared(const DiscField& field, const Rotation& rotation, double toomre_q)
{
    const DiscShape& disc = field.shape();
    const double reference = 2.5 * disc.scale_length;
    const double index = field.radius_index(reference);
    const double epicyclic =
        2 / reference *
        std::sqrt(interpolate(rotation.epicycle_squared, index) * interpolate(rotation.speed_squared, index));
    const double dispersion = toomre_q * 3.36 * disc.surface_density(reference) / epicyclic;
    // Rounded off at the centre (Hernquist 1993), which could not hold stars much faster than it rotates.
    const auto fall = [&](double radius) {
        const double core = disc.scale_length / 4;
        return portable_exp(-std::sqrt(radius * radius + 2 * core * core) / disc.scale_length);
    };
    Column wanted;
    for (std::size_t i = 0; i <= last; ++i)
        wanted.push_back(dispersion * dispersion * fall(field.radius(double(i))) / fall(reference));
    return wanted;
}

/// The distribution function: stars by guiding radius.
struct Stars {
    Column surface_density;
    Column radial_squared;
};

/// Stars at radius `i` below each angular momentum: their share of the surface density.
Column stars_below(const DiscField& field, const Rotation& rotation, const Stars& stars, std::size_t i)
{
    const double r = field.radius(double(i));
    Column below{0};
    double previous = 0;
    for (std::size_t g = 1; g <= last; ++g) {
        const double guiding = field.radius(double(g));
        const double spin_squared = rotation.angular_momentum[g] * rotation.angular_momentum[g];
        const double excess = rotation.potential[i] - rotation.potential[g] +
                              0.5 * spin_squared * (1 / (r * r) - 1 / (guiding * guiding));
        const double squared = stars.radial_squared[g];
        const double density = stars.surface_density[g] * portable_exp(-std::max(excess, 0.0) / squared) /
                               std::sqrt(2 * std::numbers::pi * rotation.epicycle_squared[g] * squared);
        const double width = (rotation.angular_momentum[g] - rotation.angular_momentum[g - 1]) / r;
        below.push_back(below.back() + 0.5 * (previous + density) * width);
        previous = density;
    }
    return below;
}

/// Moves the distribution function towards the surface density and radial dispersions that are wanted.
void correct(Stars& stars, const DiscField& field, const Rotation& rotation, const Column& wanted_squared)
{
    Stars next = stars;
    for (std::size_t i = 1; i <= last; ++i) {
        const Column below = stars_below(field, rotation, stars, i);
        double squared = 0;
        for (std::size_t g = 1; g <= last; ++g)
            squared +=
                (below[g] - below[g - 1]) * 0.5 * (stars.radial_squared[g - 1] + stars.radial_squared[g]);
        const double density = field.shape().surface_density(field.radius(double(i)));
        next.surface_density[i] *= std::clamp(density / below.back(), 0.5, 2.0);
        next.radial_squared[i] *= std::clamp(wanted_squared[i] * below.back() / squared, 0.5, 2.0);
    }
    stars = std::move(next);
}

} // namespace

DiscOrbits::DiscOrbits(const DiscField& field, double toomre_q) : field_(field), guiding_(last + 1)
{
    const Rotation rotation = rotation_of(field);
    const Column wanted_squared = wanted_radial_squared(field, rotation, toomre_q);
    Stars stars{{}, wanted_squared};
    Column indices;
    for (std::size_t i = 0; i <= last; ++i) {
        stars.surface_density.push_back(field.shape().surface_density(field.radius(double(i))));
        indices.push_back(double(i));
    }
    for (int correction = 0; correction < corrections; ++correction)
        correct(stars, field, rotation, wanted_squared);
    for (std::size_t i = 1; i <= last; ++i)
        guiding_[i] = normal_quantiles(indices, stars_below(field, rotation, stars, i));
    angular_momentum_ = rotation.angular_momentum;
    epicycle_squared_ = rotation.epicycle_squared;
    radial_squared_ = stars.radial_squared;
}

OrbitInPlane DiscOrbits::at(double radius, double deviate) const
{
    const double x = field_.radius_index(radius);
    const std::size_t i = std::min(std::size_t(x), last - 1);
    const double inner = value_at(guiding_[i], deviate), outer = value_at(guiding_[i + 1], deviate);
    const double guiding = inner + (x - double(i)) * (outer - inner);
    return {interpolate(angular_momentum_, guiding) / radius,
            std::sqrt(interpolate(radial_squared_, guiding)), field_.radius(guiding)};
}

double DiscOrbits::circular_speed(double radius) const
{
    return interpolate(angular_momentum_, field_.radius_index(radius)) / radius;
}

double DiscOrbits::epicyclic_frequency(double radius) const
{
    const double ratio = std::sqrt(interpolate(epicycle_squared_, field_.radius_index(radius)));
    return 2 * ratio * circular_speed(radius) / radius;
}

} // namespace slod
