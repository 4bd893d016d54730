#include "effects/uniform_fields.hpp"

#include <cmath>

#include "core/portable_math.hpp"

namespace slod {
double drag_fall(double drag, double time)
{
    const double x = drag * time;
    if (std::abs(x) > 0.1)
        return (time - drag_drift(drag, time)) / drag;
    // Taylor series: the difference above would cancel. The first term left out is x^10 / 12!.
    double sum = 0;
    double term = 0.5;
    for (int n = 3; n <= 12; ++n) {
        sum += term;
        term *= -x / n;
    }
    return time * time * sum;
}

UniformFields::UniformFields(const std::optional<UniformGravitySettings>& uniform_gravity,
                             const std::optional<LinearDragSettings>& linear_drag,
                             const std::optional<UniformWindSettings>& uniform_wind)
{
    if (uniform_gravity)
        gravity = uniform_gravity->acceleration;
    if (linear_drag)
        drag = linear_drag->rate;
    if (uniform_wind && linear_drag)
        wind = uniform_wind->velocity;
}

Propagator UniformFields::over(double time) const
{
    Propagator step;
    step.drift = drag_drift(drag, time);
    step.decay_minus_1 = drag == 0 ? 0.0 : portable_expm1(-drag * time);
    const double carried = drag_fall(drag, time);
    step.shift = drag * carried * wind + carried * gravity;
    step.gain = -step.decay_minus_1 * wind + step.drift * gravity;
    return step;
}

} // namespace slod
