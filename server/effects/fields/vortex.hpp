#pragma once

#include "effects/fields/field.hpp"

namespace slod {

/// A line about which everything is turned.
struct VortexSettings {
    Vector3d position{0, 0, 0}; ///< of any point on the line, scene length
    Vector3d axis{0, 0, 1};     ///< any length but 0; turns by the right hand
    double strength = 1;      ///< acceleration times distance, far away: length^2 / time^2; below 0 it turns
                              ///< the other way
    double core_radius = 0.5; ///< where the acceleration is largest; scene length

    friend bool operator==(const VortexSettings&, const VortexSettings&) = default;
};

template <class Visitor>
void for_each_field(VortexSettings& vortex, Visitor&& visit)
{
    visit(Field{"position", "length", "A point on the line.", -1e30, 1e30}, vortex.position);
    visit(Field{"axis", "", "Direction of the line; it turns by the right hand.", -1e30, 1e30}, vortex.axis);
    visit(Field{"strength", "length^2/time^2", "Acceleration times distance, outside the core.", -1e30, 1e30},
          vortex.strength);
    visit(Field{"core_radius", "length", "Where the acceleration is largest; more than 0.", 0, 1e30},
          vortex.core_radius);
}

/// An acceleration about the line, strength r / (r^2 + core^2) at the distance r from it. It has a curl, so
/// no potential, and its gradient is not symmetric.
class Vortex {
public:
    using Settings = VortexSettings;
    using Table = std::vector<Settings>;
    static constexpr std::string_view name = "vortex";
    static constexpr std::string_view help = "Lines that particles are accelerated about.";
    static constexpr bool symmetric = false;

    static Problems problems(const Settings& settings, double step);

    Vortex(const Settings& settings, const FieldSource&);

    bool acts() const { return settings_.strength != 0; }
    Box bounds() const { return unbounded(); }
    void add(const Vector3d& x, double time, FieldValue& sum) const;

private:
    Settings settings_;
    Matrix3d turn_; ///< takes d to axis x d
};

} // namespace slod
