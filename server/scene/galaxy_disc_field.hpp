#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "scene/galaxy_mass.hpp"

namespace slod {

/// The potential in and about a disc, G = 1: its own and that of spheres about its centre. A table over
/// radius (from the axis, growing with the square of its index) and height (above the plane, evenly).
class DiscField {
public:
    static constexpr std::size_t radius_steps = 320;
    static constexpr std::size_t height_steps = 64;

    /// `softening` between the disc's own particles; `spheroid_potential` by distance from the centre, as
    /// the disc's particles feel it.
    DiscField(const DiscShape& shape, double softening,
              const std::function<double(double)>& spheroid_potential);

    const DiscShape& shape() const { return shape_; }
    double radius(double index) const
    {
        return shape_.outer_radius() * index * index / (radius_steps * radius_steps);
    }
    double radius_index(double radius) const; ///< held inside the table
    double height(double index) const;
    double height_index(double height) const; ///< of either side; held inside the table

    double potential(std::size_t radius_index, std::size_t height_index) const
    {
        return potential_[radius_index * (height_steps + 1) + height_index];
    }

    /// Of the disc's density at that height, relative to the plane.
    double relative_density(std::size_t height_index) const { return relative_density_[height_index]; }

    /// The fastest that a bound particle can be.
    double escape_speed(double radius, double height) const;

private:
    DiscShape shape_;
    std::vector<double> potential_;
    std::vector<double> relative_density_;
};

} // namespace slod
