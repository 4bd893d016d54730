#include "tree/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>

#include "core/number_text.hpp"
#include "core/portable_math.hpp"

namespace slod {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Summed in this order everywhere, so that a corner beyond a point never comes out on this side of it.
double dot(const Vector3d& a, const Vector3d& b)
{
    return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

double squared(const Vector3d& a)
{
    return dot(a, a);
}

/// The corner of the box that lies farthest along `normal`.
Vector3d farthest_corner(const Box& box, const Vector3d& normal)
{
    return (normal.array() > 0).select(box.upper, box.lower);
}

Vector3d nearest_point(const Box& box, const Vector3d& x)
{
    return x.cwiseMax(box.lower).cwiseMin(box.upper);
}

/// Axes of a frustum, orthonormal.
struct Sight {
    Vector3d forward, right, upward;
    double rise, width; ///< tangents of half the angles of view
};

Sight sight_of(const RegionOfInterest& region)
{
    const Vector3d forward = region.direction.normalized();
    const Vector3d right = forward.cross(region.up).normalized();
    const auto half = portable_sincos(region.field_of_view_deg * std::numbers::pi / 360);
    const double rise = half.sine / half.cosine;
    return {forward, right, right.cross(forward), rise, rise * region.aspect};
}

/// A box around the frustum, a little wider than the rounding of its corners.
Box frustum_bounds(const RegionOfInterest& region, const Sight& sight)
{
    Box bounds{Vector3d::Constant(unlimited), Vector3d::Constant(-unlimited)};
    for (const double depth : {region.near_distance, region.far_distance})
        for (const double across : {-sight.width, sight.width})
            for (const double above : {-sight.rise, sight.rise}) {
                const Vector3d corner =
                    region.centre + depth * (sight.forward + across * sight.right + above * sight.upward);
                bounds.lower = bounds.lower.cwiseMin(corner);
                bounds.upper = bounds.upper.cwiseMax(corner);
            }
    const double margin = 1e-12 * (bounds.lower.cwiseAbs().maxCoeff() + bounds.upper.cwiseAbs().maxCoeff());
    return {bounds.lower.array() - margin, bounds.upper.array() + margin};
}

/// Finds the numbers that are outside of their ranges.
struct RangeCheck {
    Problems& found;

    void operator()(const Field& field, double value) const
    {
        const bool within = value >= field.minimum && value <= field.maximum;
        if (!within || (!field.infinity_allowed && std::isinf(value)))
            found.push_back(std::string(field.key) + " = " + number_text(value) + " is out of range.");
    }
    void operator()(const Field& field, std::int64_t value) const { (*this)(field, double(value)); }
    void operator()(const Field& field, const Vector3d& value) const
    {
        for (const double component : value)
            (*this)(field, component);
    }
    template <class Other>
    void operator()(const Field&, const Other&) const
    {}
};

} // namespace

RegionTest::RegionTest(const RegionOfInterest& region)
    : shape_(region.shape), bounds_{Vector3d::Constant(-unlimited), Vector3d::Constant(unlimited)},
      centre_(region.centre), least_mass_(region.least_mass), most_mass_(region.most_mass),
      least_speed_(region.least_speed), most_speed_(region.most_speed),
      least_acceleration_(region.least_acceleration), most_acceleration_(region.most_acceleration)
{
    selective_ = least_mass_ > 0 || least_speed_ > 0 || least_acceleration_ > 0 ||
                 std::isfinite(most_mass_) || std::isfinite(most_speed_) || std::isfinite(most_acceleration_);
    if (shape_ == Shape::Box) {
        bounds_ = {centre_ - region.half_extent, centre_ + region.half_extent};
    } else if (shape_ == Shape::Sphere) {
        const Vector3d reach = Vector3d::Constant(region.radius);
        bounds_ = {centre_ - reach, centre_ + reach};
        radius_squared_ = region.radius * region.radius;
    } else if (shape_ == Shape::Frustum) {
        set_frustum(region);
    }
}

void RegionTest::set_frustum(const RegionOfInterest& region)
{
    const Sight sight = sight_of(region);
    const auto add = [&](const Vector3d& normal, double beyond) {
        planes_[plane_count_++] = {normal, dot(normal, region.centre) + beyond};
    };
    add(sight.rise * sight.forward - sight.upward, 0);
    add(sight.rise * sight.forward + sight.upward, 0);
    add(sight.width * sight.forward - sight.right, 0);
    add(sight.width * sight.forward + sight.right, 0);
    add(sight.forward, region.near_distance);
    if (std::isfinite(region.far_distance)) {
        add(-sight.forward, -region.far_distance);
        bounds_ = frustum_bounds(region, sight);
    }
}

bool RegionTest::holds(const Vector3d& x) const
{
    switch (shape_) {
    case Shape::Everywhere:
        return true;
    case Shape::Box:
        return bounds_.contains(x);
    case Shape::Sphere:
        return squared(x - centre_) < radius_squared_;
    case Shape::Frustum:
        for (std::size_t i = 0; i < plane_count_; ++i)
            if (!(dot(planes_[i].normal, x) >= planes_[i].offset))
                return false;
        return true;
    }
    return false;
}

bool RegionTest::contains(const Subject& subject) const
{
    const auto within = [](double value, double least, double most) {
        return value >= least && value < most;
    };
    return holds(subject.position) &&
           (!selective_ || (within(subject.mass, least_mass_, most_mass_) &&
                            within(subject.speed, least_speed_, most_speed_) &&
                            within(subject.acceleration, least_acceleration_, most_acceleration_)));
}

bool RegionTest::misses(const Box& box) const
{
    switch (shape_) {
    case Shape::Everywhere:
        return false;
    case Shape::Box:
        return (box.lower.array() >= bounds_.upper.array()).any() ||
               (box.upper.array() <= bounds_.lower.array()).any() ||
               (bounds_.lower.array() >= bounds_.upper.array()).any();
    case Shape::Sphere:
        return squared(nearest_point(box, centre_) - centre_) >= radius_squared_;
    case Shape::Frustum:
        for (std::size_t i = 0; i < plane_count_; ++i)
            if (dot(planes_[i].normal, farthest_corner(box, planes_[i].normal)) < planes_[i].offset)
                return true;
        return false;
    }
    return false;
}

bool RegionTest::covers(const Box& box) const
{
    if (selective_)
        return false;
    switch (shape_) {
    case Shape::Everywhere:
        return true;
    case Shape::Box:
        return (box.lower.array() >= bounds_.lower.array()).all() &&
               (box.upper.array() <= bounds_.upper.array()).all();
    case Shape::Sphere:
        return squared((box.lower - centre_).cwiseAbs().cwiseMax((box.upper - centre_).cwiseAbs())) <
               radius_squared_;
    case Shape::Frustum:
        for (std::size_t i = 0; i < plane_count_; ++i)
            if (!(dot(planes_[i].normal, farthest_corner(box, -planes_[i].normal)) >= planes_[i].offset))
                return false;
        return true;
    }
    return false;
}

bool same_place(const RegionOfInterest& a, const RegionOfInterest& b)
{
    const auto place = [](const RegionOfInterest& r) {
        return std::tie(r.precedence, r.shape, r.centre, r.half_extent, r.radius, r.direction, r.up,
                        r.field_of_view_deg, r.aspect, r.near_distance, r.far_distance, r.least_mass,
                        r.most_mass, r.least_speed, r.most_speed, r.least_acceleration, r.most_acceleration);
    };
    return place(a) == place(b);
}

double greatest_width(const RegionOfInterest& region)
{
    switch (region.shape) {
    case Shape::Everywhere:
        return unlimited;
    case Shape::Box:
        return 2 * region.half_extent.maxCoeff();
    case Shape::Sphere:
        return 2 * region.radius;
    case Shape::Frustum: {
        // Between opposite corners of its far face, or from one of them to the eye.
        const Sight sight = sight_of(region);
        const double across = sight.rise * sight.rise + sight.width * sight.width;
        return region.far_distance * std::sqrt(std::max(4 * across, 1 + across));
    }
    }
    return unlimited;
}

bool may_overlap(const RegionOfInterest& a, const RegionOfInterest& b)
{
    const Box first = RegionTest(a).bounds(), second = RegionTest(b).bounds();
    const auto meet = [](double a_least, double a_most, double b_least, double b_most) {
        return a_least < b_most && b_least < a_most;
    };
    return (first.lower.array() < second.upper.array()).all() &&
           (second.lower.array() < first.upper.array()).all() &&
           meet(a.least_mass, a.most_mass, b.least_mass, b.most_mass) &&
           meet(a.least_speed, a.most_speed, b.least_speed, b.most_speed) &&
           meet(a.least_acceleration, a.most_acceleration, b.least_acceleration, b.most_acceleration);
}

Problems problems(const RegionOfInterest& region)
{
    Problems found;
    RegionOfInterest visited = region;
    for_each_field(visited, RangeCheck{found});
    if (region.shape == Shape::Frustum) {
        if (region.direction.isZero(0))
            found.push_back(
                "direction = [0, 0, 0] is none; give the direction of sight, such as [0, 0, -1].");
        else if (!(region.direction.normalized().cross(region.up.normalized()).norm() > 1e-6))
            found.push_back("up is along the direction of sight, or 0; give one across it.");
        if (region.near_distance >= region.far_distance)
            found.push_back("near is not before far; use less.");
    }
    if (region.follows.size() > longest_client_name)
        found.push_back("follows is longer than " + std::to_string(longest_client_name) +
                        " characters; use a client's name.");
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(region.follows.begin(), region.follows.end(),
                    is_control)) // it comes to terminals and logs
        found.push_back("follows has control characters; use a client's name.");
    const auto check = [&](std::string_view quantity, double least, double most) {
        if (least >= most)
            found.push_back("least_" + std::string(quantity) + " is not below most_" + std::string(quantity) +
                            ", which leaves nothing; use less.");
    };
    check("mass", region.least_mass, region.most_mass);
    check("speed", region.least_speed, region.most_speed);
    check("acceleration", region.least_acceleration, region.most_acceleration);
    return found;
}

} // namespace slod
