#include "scene/galaxy_disc_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/parallel.hpp"
#include "core/portable_math.hpp"

namespace slod {

namespace {

constexpr double table_top = 8; ///< scale heights; one star in four million is higher
constexpr int layer_reach = 24; ///< layers on each side of the plane
constexpr double layers_per_scale_height = 4;
constexpr std::size_t thin_steps = 48;

double sech_squared(double x)
{
    const double e = portable_exp(-2 * std::abs(x));
    return 4 * e / ((1 + e) * (1 + e));
}

/// Cubic through the four nearest of equidistant values.
double cubic(std::span<const double> values, double index)
{
    const std::size_t first = std::min(std::size_t(std::max(index - 1, 0.0)), values.size() - 4);
    const double x = index - double(first);
    return values[first] * (x - 1) * (x - 2) * (x - 3) / -6 + values[first + 1] * x * (x - 2) * (x - 3) / 2 +
           values[first + 2] * x * (x - 1) * (x - 3) / -2 + values[first + 3] * x * (x - 1) * (x - 2) / 6;
}

/// The disc's own potential at one distance from the axis: that of a thin disc, averaged over the layers of
/// the thick one.
class DiscColumn {
public:
    DiscColumn(const DiscShape& shape, std::span<const MassAtRadius> rings, double radius, double softening)
        : shape_(shape), softening_(softening)
    {
        const double farthest =
            (table_top + layer_reach / layers_per_scale_height) * shape.scale_height + softening;
        step_ = (farthest - softening) / thin_steps;
        for (std::size_t k = 0; k < thin_.size(); ++k) {
            const double distance = softening + double(k) * step_;
            thin_[k] = ring_potential(rings, radius, distance * distance);
        }
    }

    double potential(double height) const
    {
        double sum = 0, weights = 0;
        for (int layer = -layer_reach; layer <= layer_reach; ++layer) {
            const double from_plane = layer / layers_per_scale_height;
            const double apart = height - from_plane * shape_.scale_height;
            const double distance = std::sqrt(apart * apart + softening_ * softening_);
            const double weight = sech_squared(from_plane);
            sum += weight * cubic(thin_, (distance - softening_) / step_);
            weights += weight;
        }
        return sum / weights;
    }

private:
    DiscShape shape_;
    double softening_;
    double step_;
    std::array<double, thin_steps + 1> thin_; ///< potential of a thin disc, by softened distance from it
};

} // namespace

DiscField::DiscField(const DiscShape& shape, double softening,
                     const std::function<double(double)>& spheroid_potential)
    : shape_(shape), potential_((radius_steps + 1) * (height_steps + 1))
{
    for (std::size_t j = 0; j <= height_steps; ++j)
        relative_density_.push_back(sech_squared(height(double(j)) / shape.scale_height));
    const auto rings = disc_profile(shape).pieces();
    // Closer than half a ring's width the sum over rings would show the gaps between them.
    const double resolved = std::max(softening, 0.5 * shape.outer_radius() / double(rings.size()));
    for_each_task(radius_steps + 1, [&](std::size_t i) {
        const double r = radius(double(i));
        const DiscColumn column(shape, rings, r, resolved);
        for (std::size_t j = 0; j <= height_steps; ++j) {
            const double z = height(double(j));
            potential_[i * (height_steps + 1) + j] =
                column.potential(z) + spheroid_potential(std::sqrt(r * r + z * z));
        }
    });
}

double DiscField::radius_index(double radius) const
{
    return std::sqrt(std::min(radius / shape_.outer_radius(), 1.0)) * radius_steps;
}

double DiscField::height(double index) const
{
    return table_top * shape_.scale_height * index / height_steps;
}

double DiscField::height_index(double height) const
{
    return std::min(std::abs(height) / (table_top * shape_.scale_height), 1.0) * height_steps;
}

double DiscField::escape_speed(double radius, double height) const
{
    // The highest potential about the place: on the safe side by less than a percent.
    const std::size_t i = std::min(std::size_t(radius_index(radius)) + 1, radius_steps);
    const std::size_t j = std::min(std::size_t(height_index(height)) + 1, height_steps);
    return std::sqrt(-2 * potential(i, j));
}

} // namespace slod
