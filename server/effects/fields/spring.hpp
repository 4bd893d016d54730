#pragma once

#include "effects/fields/field.hpp"

namespace slod {

/// Ties every particle to an anchor.
struct SpringSettings {
    Vector3d anchor{0, 0, 0}; ///< scene length
    double stiffness = 1;     ///< acceleration per length: 1 / time^2

    friend bool operator==(const SpringSettings&, const SpringSettings&) = default;
};

template <class Visitor>
void for_each_field(SpringSettings& spring, Visitor&& visit)
{
    visit(Field{"anchor", "length", "Where it is at rest.", -1e30, 1e30}, spring.anchor);
    visit(Field{"stiffness", "1/time^2", "Acceleration per length: the square of the angular frequency.", 0,
                1e30},
          spring.stiffness);
}

/// The potential stiffness r^2 / 2, which is linear: clusters follow it exactly.
class Spring {
public:
    using Settings = SpringSettings;
    using Table = std::vector<Settings>;
    static constexpr std::string_view name = "spring";
    static constexpr std::string_view help = "Anchors that pull particles in proportion to their distance.";
    static constexpr bool symmetric = true;

    /// Kicks at the ends of a frame are stable up to an angular frequency of 2 / step.
    static Problems problems(const Settings& settings, double step);

    /// Springs together are one whose stiffness is the sum of theirs.
    static Problems problems_together(const Table& springs, double step);

    Spring(const Settings& settings, const FieldSource&) : settings_(settings) {}

    bool acts() const { return settings_.stiffness != 0; }
    Box bounds() const { return unbounded(); }

    void add(const Vector3d& x, double, FieldValue& sum) const
    {
        sum.value -= settings_.stiffness * (x - settings_.anchor);
        sum.gradient.diagonal().array() -= settings_.stiffness;
    }

    double potential(const Vector3d& x) const
    {
        return 0.5 * settings_.stiffness * (x - settings_.anchor).squaredNorm();
    }

private:
    Settings settings_;
};

} // namespace slod
