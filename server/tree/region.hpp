#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/settings.hpp"
#include "core/vectors.hpp"
#include "tree/box.hpp"
#include "tree/settings.hpp"

namespace slod {

enum class Shape : std::uint8_t { Everywhere, Box, Sphere, Frustum };

constexpr std::array<std::string_view, 4> names(Shape)
{
    return {"everywhere", "box", "sphere", "frustum"};
}

/// A region of interest: a part of space, or of what is in it by mass, speed or acceleration, with
/// partitioning parameters of its own (O'Brien et al. 2001, sections 4 and 5.1).
struct RegionOfInterest {
    std::string name;
    std::int64_t precedence = 0; ///< where regions overlap the highest takes; of equals the earlier one
    Shape shape = Shape::Everywhere;

    Vector3d centre{0, 0, 0};      ///< of a box or sphere; the eye of a frustum; scene length
    Vector3d half_extent{1, 1, 1}; ///< of a box; scene length
    double radius = 1;             ///< of a sphere; scene length

    // A frustum.
    Vector3d direction{0, 0, -1};                                  ///< of sight, any length but 0
    Vector3d up{0, 1, 0};                                          ///< not along the direction
    double field_of_view_deg = 60;                                 ///< vertical
    double aspect = 16.0 / 9;                                      ///< width by height
    double near_distance = 0;                                      ///< scene length
    double far_distance = std::numeric_limits<double>::infinity(); ///< scene length
    std::string follows{}; ///< client whose view moves it; empty: none
    double view_share = 1; ///< its field of view, in those of the view it follows

    // What of it: clusters whose particles have such a mean mass, speed and acceleration, [least, most).
    double least_mass = 0, most_mass = std::numeric_limits<double>::infinity();
    double least_speed = 0, most_speed = std::numeric_limits<double>::infinity();
    double least_acceleration = 0, most_acceleration = std::numeric_limits<double>::infinity();

    RegionSettings partition;

    friend bool operator==(const RegionOfInterest&, const RegionOfInterest&) = default;
};

/// Bytes of the name of a client that a region may follow.
inline constexpr std::size_t longest_client_name = 64;

/// Name of the region that holds whatever no other one does.
inline constexpr std::string_view background_name = "background";

/// What a region asks of a cluster, or of a particle on its way to one.
struct Subject {
    Subject(const Vector3d& x, double particle_mass = 0, double v = 0, double a = 0)
        : position(x), mass(particle_mass), speed(v), acceleration(a)
    {}

    Vector3d position;   ///< scene length
    double mass;         ///< mean of the particles
    double speed;        ///< scene length / time
    double acceleration; ///< scene length / time^2
};

/// A region's shape and ranges, ready for many questions.
class RegionTest {
public:
    explicit RegionTest(const RegionOfInterest& region);

    bool contains(const Subject& subject) const;

    /// Whether nothing in the box is, or may be, in the region: never true falsely.
    bool misses(const Box& box) const;

    /// Whether everything in the box is in the region, whatever its mass or motion: never true falsely.
    bool covers(const Box& box) const;

    /// A box around the shape, infinite where the shape is.
    const Box& bounds() const { return bounds_; }

    /// Whether it asks for more than the place.
    bool selective() const { return selective_; }

private:
    struct Plane {
        Vector3d normal; ///< inwards
        double offset;   ///< x is inside where normal . x >= offset
    };

    void set_frustum(const RegionOfInterest& region);
    bool holds(const Vector3d& x) const;

    Shape shape_;
    Box bounds_;
    Vector3d centre_;
    double radius_squared_ = 0;
    std::array<Plane, 6> planes_{};
    std::size_t plane_count_ = 0;
    bool selective_ = false;
    double least_mass_, most_mass_, least_speed_, most_speed_, least_acceleration_, most_acceleration_;
};

/// Whether both take the same clusters where nobody else does, and from the same others: they may differ in
/// name, in parameters, and in whose view moves them.
bool same_place(const RegionOfInterest& a, const RegionOfInterest& b);

/// The largest extent that the region's shape has along an axis, however it is turned and wherever it is:
/// scene length, infinite where the shape is.
double greatest_width(const RegionOfInterest& region);

/// What is wrong with a region, each with the key in front.
Problems problems(const RegionOfInterest& region);

/// Whether something may belong in both, by a box around each and by their ranges: never false falsely.
bool may_overlap(const RegionOfInterest& a, const RegionOfInterest& b);

template <class Visitor>
void for_each_field(RegionOfInterest& region, Visitor&& visit)
{
    visit(Field{"name", "", "Name of the region: 1 to 32 of a-z, 0-9, _ and -."}, region.name);
    visit(Field{"precedence", "", "Where regions overlap the highest takes; of equals the earlier one.", -1e9,
                1e9},
          region.precedence);
    visit(Field{"shape", "", "Which of the fields below say where the region is."}, region.shape);
    visit(Field{"centre", "length", "Centre of a box or a sphere, the eye of a frustum.", -1e30, 1e30},
          region.centre);
    visit(Field{"half_extent", "length", "Half the sides of a box.", 0, 1e30}, region.half_extent);
    visit(Field{"radius", "length", "Of a sphere.", 0, 1e30}, region.radius);
    visit(Field{"direction", "", "Of sight, for a frustum; any length but 0."}, region.direction);
    visit(Field{"up", "", "What is upwards for a frustum; not along the direction."}, region.up);
    visit(Field{"field_of_view", "deg", "Of a frustum, vertically.", 0.01, 179}, region.field_of_view_deg);
    visit(Field{"aspect", "", "Of a frustum, width by height.", 0.01, 100}, region.aspect);
    visit(Field{"near", "length", "Distance from the eye where a frustum begins.", 0, 1e30},
          region.near_distance);
    visit(Field{"far", "length", "Distance from the eye where a frustum ends.", 0, no_maximum, true},
          region.far_distance);
    visit(Field{"follows", "", "Name of the client whose view moves a frustum; empty: it stays."},
          region.follows);
    visit(Field{"view_share", "", "Field of view of a frustum that follows, as a share of the view's.", 0.01,
                4},
          region.view_share);
    visit(Field{"least_mass", "mass", "Only particles of this mass or more.", 0, 1e30}, region.least_mass);
    visit(Field{"most_mass", "mass", "Only particles below this mass.", 0, no_maximum, true},
          region.most_mass);
    visit(Field{"least_speed", "length/time", "Only what moves at this speed or faster.", 0, 1e30},
          region.least_speed);
    visit(Field{"most_speed", "length/time", "Only what moves slower than this.", 0, no_maximum, true},
          region.most_speed);
    visit(Field{"least_acceleration", "length/time^2", "Only what is accelerated so much or more.", 0, 1e30},
          region.least_acceleration);
    visit(Field{"most_acceleration", "length/time^2", "Only what is accelerated less than this.", 0,
                no_maximum, true},
          region.most_acceleration);
    for_each_field(region.partition, visit);
}

} // namespace slod
