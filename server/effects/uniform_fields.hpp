#pragma once

#include <optional>

#include "cluster/flow_map.hpp"
#include "effects/settings.hpp"

namespace slod {

/// What linear drag k makes of a time h.
struct Damping {
    double time = 0;          ///< h
    double decay_minus_1 = 0; ///< exp(-k h) - 1
    double drift = 0;         ///< how far unit velocity carries: (1 - exp(-k h)) / k
    double fall = 0;          ///< how far unit acceleration carries: (h - drift) / k

    Damping() = default;
    Damping(double drag, double duration);
};

/// Uniform gravity g, linear drag k and uniform wind u together: dv/dt = g - k (v - u). Linear in x and v
/// with the same coefficients for all, so clusters follow it exactly.
struct UniformFields {
    Vector3d gravity{0, 0, 0};
    double drag = 0;
    Vector3d wind{0, 0, 0};

    UniformFields() = default;
    UniformFields(const std::optional<UniformGravitySettings>& uniform_gravity,
                  const std::optional<LinearDragSettings>& linear_drag,
                  const std::optional<UniformWindSettings>& uniform_wind);

    /// Of what is at rest.
    Vector3d acceleration() const { return gravity + drag * wind; }

    /// The exact flow over `time`.
    Propagator over(double time) const { return over(Damping(drag, time)); }
    Propagator over(const Damping& time) const; ///< under the drag of these fields
};

/// (h - (1 - exp(-k h)) / k) / k: how far a unit of constant acceleration carries in time h under drag k;
/// h^2 / 2 without drag.
double drag_fall(double drag, double time);

} // namespace slod
