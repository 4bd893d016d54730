#pragma once

#include "effects/fields/field.hpp"

namespace slod {

/// Moving air, in a box or everywhere.
struct WindSettings {
    Vector3d velocity{1, 0, 0};    ///< scene length / time
    Vector3d centre{0, 0, 0};      ///< of the box, scene length
    Vector3d half_extent{1, 1, 1}; ///< of the box, inf along an axis for no bounds there; scene length
    double edge = 0.5;             ///< depth within a face over which the wind sets in, half_extent at most
    double gust_amplitude = 0;     ///< as a share of the velocity
    double gust_period = 1;        ///< time

    friend bool operator==(const WindSettings&, const WindSettings&) = default;
};

template <class Visitor>
void for_each_field(WindSettings& wind, Visitor&& visit)
{
    visit(Field{"velocity", "length/time", "Velocity of the air; acts through the drag.", -1e30, 1e30},
          wind.velocity);
    visit(Field{"centre", "length", "Centre of the box where it blows.", -1e30, 1e30}, wind.centre);
    visit(Field{"half_extent", "length", "Half sides of the box; inf for no bounds along an axis.", 0,
                no_maximum, true},
          wind.half_extent);
    visit(Field{"edge", "length",
                "Depth within each face over which the wind sets in, the least half_extent at most; clusters "
                "that reach across an end of it are counted.",
                0, 1e30},
          wind.edge);
    visit(
        Field{"gust_amplitude", "", "Gusts add this share of the velocity, and take it, as a sine.", 0, 1e30},
        wind.gust_amplitude);
    visit(Field{"gust_period", "time", "From gust to gust; the first is a quarter of it after the start.",
                1e-30, 1e30},
          wind.gust_period);
}

/// The velocity times a smooth step from each face of the box inwards, times 1 + amplitude sin of the time.
class Wind {
public:
    using Settings = WindSettings;
    using Table = std::vector<Settings>;
    static constexpr std::string_view name = "wind";
    static constexpr std::string_view help = "Moving air in a box, with gusts; needs a drag.";
    static constexpr bool symmetric = false;

    static Problems problems(const Settings& settings, double step);

    Wind(const Settings& settings, const FieldSource&) : settings_(settings) {}

    bool acts() const { return !settings_.velocity.isZero(0); }
    Box bounds() const
    {
        return {settings_.centre - settings_.half_extent, settings_.centre + settings_.half_extent};
    }
    void add(const Vector3d& x, double time, FieldValue& sum) const;

    /// From the faces of the box, and from the planes within it from which on the wind is whole.
    double clearance(const Vector3d& x) const;

    /// Whether it is the same at every place.
    bool uniform() const { return settings_.half_extent.array().isInf().all(); }

private:
    double gust(double time) const;

    Settings settings_;
};

} // namespace slod
