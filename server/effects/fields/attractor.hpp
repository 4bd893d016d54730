#pragma once

#include <cmath>

#include "effects/fields/field.hpp"

namespace slod {

/// A point that attracts everything, or repels it.
struct AttractorSettings {
    Vector3d position{0, 0, 0};                              ///< scene length
    double strength = 1;                                     ///< G M: length^3 / time^2; below 0 it repels
    double softening = 0.5;                                  ///< scene length
    double radius = std::numeric_limits<double>::infinity(); ///< of action; scene length

    friend bool operator==(const AttractorSettings&, const AttractorSettings&) = default;
};

template <class Visitor>
void for_each_field(AttractorSettings& attractor, Visitor&& visit)
{
    visit(Field{"position", "length", "Where it is.", -1e30, 1e30}, attractor.position);
    visit(Field{"strength", "length^3/time^2", "Acceleration at unit distance; below 0 it repels.", -1e30,
                1e30},
          attractor.strength);
    visit(Field{"softening", "length", "Plummer softening length; more than 0.", 0, 1e30},
          attractor.softening);
    visit(Field{"radius", "length",
                "Its pull fades towards this distance, and is none beyond; clusters that reach across are "
                "counted.",
                0, no_maximum, true},
          attractor.radius);
}

/// The potential -strength / sqrt(r^2 + softening^2), times (1 - (r / radius)^2)^3 within the radius: the
/// acceleration and its gradient fade continuously.
class Attractor {
public:
    using Settings = AttractorSettings;
    using Table = std::vector<Settings>;
    static constexpr std::string_view name = "attractor";
    static constexpr std::string_view help = "Points that attract or repel particles.";
    static constexpr bool symmetric = true;

    static Problems problems(const Settings& settings, double step);

    Attractor(const Settings& settings, const FieldSource&) : settings_(settings) {}

    bool acts() const { return settings_.strength != 0; }
    Box bounds() const;
    void add(const Vector3d& x, double time, FieldValue& sum) const;
    double potential(const Vector3d& x) const;

    /// From the sphere where the pull ends.
    double clearance(const Vector3d& x) const
    {
        return std::abs((x - settings_.position).norm() - settings_.radius);
    }

private:
    Settings settings_;
};

} // namespace slod
