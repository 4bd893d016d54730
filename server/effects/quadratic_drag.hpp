#pragma once

#include "core/settings.hpp"
#include "core/vectors.hpp"

namespace slod {

/// Air resistance in proportion to the square of the speed relative to the air.
struct QuadraticDragSettings {
    double coefficient = 0.1; ///< 1 / scene length

    friend bool operator==(const QuadraticDragSettings&, const QuadraticDragSettings&) = default;
};

template <class Visitor>
void for_each_field(QuadraticDragSettings& drag, Visitor&& visit)
{
    visit(Field{"coefficient", "1/length",
                "Velocity relative to the air decays at this rate times the relative speed.", 0, 1e30},
          drag.coefficient);
}

/// The rate k that linear drag has to have to do in a frame what k1 + k2 |w| does, and how it changes with w.
struct MeanDrag {
    double rate = 0;         ///< 1 / time
    Vector3d slope{0, 0, 0}; ///< d rate / d w: 1 / length
};

/// For a velocity `relative` to the air, w, over `time`, under uniform `gravity` g: the mean of k1 + k2 |w|.
/// The speed follows dw/dt = a - (k1 + k2 w) w with a the gravity along w, whose closed form (Riccati's)
/// gives the integral. So motion under this rate is exact at the terminal velocity and without gravity;
/// elsewhere rate and a change within the frame, and it is right to second order in the time.
MeanDrag mean_drag(double linear, double quadratic, const Vector3d& relative, const Vector3d& gravity,
                   double time);

} // namespace slod
