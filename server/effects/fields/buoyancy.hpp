#pragma once

#include <cmath>

#include "effects/fields/field.hpp"

namespace slod {

/// Water that lifts what is in it.
struct BuoyancySettings {
    double level = 0;        ///< height of the surface; scene length
    Vector3d up{0, 0, 1};    ///< any length but 0
    double lift = 1;         ///< acceleration under water, against that of gravity: length / time^2
    double transition = 0.5; ///< depth over which the lift sets in, half of it above the level; scene length

    friend bool operator==(const BuoyancySettings&, const BuoyancySettings&) = default;
};

template <class Visitor>
void for_each_field(BuoyancySettings& buoyancy, Visitor&& visit)
{
    visit(Field{"level", "length", "Height of the surface along `up`.", -1e30, 1e30}, buoyancy.level);
    visit(Field{"up", "", "Direction of the lift; any length but 0.", -1e30, 1e30}, buoyancy.up);
    visit(Field{"lift", "length/time^2", "Acceleration of what is under water, besides gravity's.", -1e30,
                1e30},
          buoyancy.lift);
    visit(Field{"transition", "length",
                "Depth over which the lift sets in, half of it above the level; clusters that reach across "
                "an end of it are counted.",
                0, 1e30},
          buoyancy.transition);
}

/// A lift that sets in smoothly about a level, as of a body that is half above it.
class Buoyancy {
public:
    using Settings = BuoyancySettings;
    using Table = std::vector<Settings>;
    static constexpr std::string_view name = "buoyancy";
    static constexpr std::string_view help = "Water that lifts what is below its level.";
    static constexpr bool symmetric = true;

    static Problems problems(const Settings& settings, double)
    {
        Problems found;
        if (settings.up.isZero(0))
            found.push_back("up = [0, 0, 0] is no direction; use one such as [0, 0, 1].");
        if (settings.transition <= 0)
            found.push_back("transition = 0 is a jump, which no cluster can follow; use more than 0.");
        return found;
    }

    Buoyancy(const Settings& settings, const FieldSource&)
        : settings_(settings), up_(settings.up.stableNormalized())
    {}

    bool acts() const { return settings_.lift != 0; }
    Box bounds() const { return unbounded(); }

    void add(const Vector3d& x, double, FieldValue& sum) const
    {
        const SmoothStep under(depth(x));
        sum.value += settings_.lift * under.value * up_;
        sum.gradient -= (settings_.lift * under.slope / settings_.transition) * up_ * up_.transpose();
    }

    double potential(const Vector3d& x) const
    {
        return settings_.lift * settings_.transition * SmoothStep(depth(x)).integral;
    }

    /// From the planes where the lift begins and from which on it is whole.
    double clearance(const Vector3d& x) const
    {
        return settings_.transition * std::abs(std::abs(depth(x) - 0.5) - 0.5);
    }

private:
    /// 0 where the lift begins, 1 where it is whole.
    double depth(const Vector3d& x) const
    {
        return (settings_.level - up_.dot(x)) / settings_.transition + 0.5;
    }

    Settings settings_;
    Vector3d up_;
};

} // namespace slod
