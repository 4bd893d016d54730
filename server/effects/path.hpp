#pragma once

#include <limits>

#include "effects/solid.hpp"
#include "effects/sweep.hpp"

namespace slod {

/// What a time comes to under a drag: v = decay v0 + drift a, x = x0 + drift v0 + fall a.
struct Elapsed {
    double time = 0, decay = 1, drift = 0, fall = 0;

    Elapsed() = default;
    Elapsed(double drag, double duration);
};

/// Where a particle or a cluster's centre is on its way: dv/dt = acceleration - drag v, exactly.
struct Path {
    Vector3d position, velocity;
    Vector3d acceleration; ///< of what is at rest
    double drag;

    Vector3d position_after(const Elapsed& elapsed) const
    {
        return position + elapsed.drift * velocity + elapsed.fall * acceleration;
    }
    Vector3d velocity_after(const Elapsed& elapsed) const
    {
        return elapsed.decay * velocity + elapsed.drift * acceleration;
    }

    /// A box that holds the whole way.
    Box bounds(const Elapsed& elapsed) const;

    /// The way, straightened, with all within `reach` of it.
    Sweep sweep(const Elapsed& elapsed, double reach) const;

    /// How far the way may be from its chord, along each axis.
    Vector3d stray(const Elapsed& elapsed) const;
};

/// No time at all: never.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// When the path first comes within `reach` of the solid, at most `limit` from now; else never. The way in
/// between counts, not the ends: with a convex solid, all within reach of it is on the far side of the plane
/// across the way to its nearest point, so whoever has not reached that plane has not reached the solid. From
/// plane to plane the time of contact is approached and not passed. With `leaving`, the path starts on the
/// surface, on its way out or along, and the question is when it comes back. Where the solid has a cover, it
/// is not met.
double first_contact(const Path& path, const Solid& solid, double reach, const Elapsed& limit, bool leaving);

/// Distances below this are rounding: some fifty of the largest coordinate.
double contact_tolerance(const Vector3d& position);

} // namespace slod
