#include "scene/galaxy_disc_layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/parallel.hpp"

namespace slod {

namespace {

constexpr std::size_t stride = 4; ///< of this table's radii in the field's
constexpr std::size_t radius_steps = DiscField::radius_steps / stride;
constexpr std::size_t top = DiscField::height_steps;

/// Stars per height and vertical velocity with the energy of rest at each height, up to a constant factor.
std::vector<double> distribution_function(const DiscField& field, std::size_t i)
{
    std::vector<double> stars(top + 1);
    for (std::size_t j = 0; j < top; ++j) {
        double root = 0;
        for (std::size_t k = j; k < top; ++k) { // density is linear in the potential between heights
            const double next_root = std::sqrt(field.potential(i, k + 1) - field.potential(i, j));
            const double fall = field.relative_density(k) - field.relative_density(k + 1);
            stars[j] += fall / (field.potential(i, k + 1) - field.potential(i, k)) * (next_root - root);
            root = next_root;
        }
    }
    return stars;
}

/// Upward velocities at one place, ascending from 0, and the stars that are slower, with and without their
/// squared velocity as a factor.
struct Speeds {
    std::vector<double> speed{0}, below{0}, below_squared{0};
};

Speeds speeds_at(const DiscField& field, const std::vector<double>& stars, std::size_t i, std::size_t j)
{
    Speeds speeds;
    for (std::size_t k = j; k < top; ++k) { // stars = start + slope * v^2 / 2 between two speeds
        const double energy = field.potential(i, k) - field.potential(i, j);
        const double next_energy = field.potential(i, k + 1) - field.potential(i, j);
        const double slope = (stars[k + 1] - stars[k]) / (next_energy - energy);
        const double start = stars[k] - slope * energy;
        const auto integral = [&](double v) { return v * (start + slope * v * v / 6); };
        const auto squared_integral = [&](double v) { return v * v * v * (start / 3 + slope * v * v / 10); };
        const double a = speeds.speed.back(), b = std::sqrt(2 * next_energy);
        speeds.speed.push_back(b);
        speeds.below.push_back(speeds.below.back() + integral(b) - integral(a));
        speeds.below_squared.push_back(speeds.below_squared.back() + squared_integral(b) -
                                       squared_integral(a));
    }
    return speeds;
}

NormalQuantiles velocity_quantiles(const Speeds& speeds)
{
    const std::size_t count = speeds.speed.size();
    const double half = speeds.below.back();
    std::vector<double> velocity, below;
    for (std::size_t k = count; k-- > 1;) {
        velocity.push_back(-speeds.speed[k]);
        below.push_back(half - speeds.below[k]);
    }
    for (std::size_t k = 0; k < count; ++k) {
        velocity.push_back(speeds.speed[k]);
        below.push_back(half + speeds.below[k]);
    }
    return normal_quantiles(velocity, below);
}

} // namespace

DiscLayers::DiscLayers(const DiscField& field)
    : field_(field), quantiles_(radius_steps + 1), dispersion_(radius_steps + 1)
{
    for_each_task(radius_steps + 1, [&](std::size_t row) {
        const std::size_t i = row * stride;
        const std::vector<double> stars = distribution_function(field, i);
        double squared = 0, weights = 0;
        for (std::size_t j = 0; j < top; ++j) {
            const double weight = (j == 0 ? 0.5 : 1) * field.relative_density(j);
            const Speeds speeds = speeds_at(field, stars, i, j);
            quantiles_[row].push_back(velocity_quantiles(speeds));
            squared += weight * speeds.below_squared.back() / speeds.below.back();
            weights += weight;
        }
        dispersion_[row] = std::sqrt(squared / weights);
        quantiles_[row].emplace_back(); // nothing moves at the top of the table
    });
}

double DiscLayers::velocity(double radius, double height, double deviate) const
{
    const double x = field_.radius_index(radius) / stride, y = field_.height_index(height);
    const std::size_t i = std::min(std::size_t(x), radius_steps - 1), j = std::min(std::size_t(y), top - 1);
    const auto at = [&](std::size_t row) {
        const double lower = value_at(quantiles_[row][j], deviate),
                     upper = value_at(quantiles_[row][j + 1], deviate);
        return lower + (y - double(j)) * (upper - lower);
    };
    return at(i) + (x - double(i)) * (at(i + 1) - at(i));
}

double DiscLayers::dispersion(double radius) const
{
    const double x = field_.radius_index(radius) / stride;
    const std::size_t i = std::min(std::size_t(x), radius_steps - 1);
    return dispersion_[i] + (x - double(i)) * (dispersion_[i + 1] - dispersion_[i]);
}

} // namespace slod
