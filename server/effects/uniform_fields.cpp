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
    if (uniform_wind)
        wind = uniform_wind->velocity;
}

Damping::Damping(double drag, double duration)
    : time(duration), decay_minus_1(drag == 0 ? 0.0 : portable_expm1(-drag * duration)),
      drift(drag_drift(drag, duration)), fall(drag_fall(drag, duration))
{}

Propagator UniformFields::over(const Damping& time) const
{
    Propagator step;
    step.drift = time.drift;
    step.decay_minus_1 = time.decay_minus_1;
    step.shift = drag * time.fall * wind + time.fall * gravity;
    step.gain = -step.decay_minus_1 * wind + step.drift * gravity;
    return step;
}

} // namespace slod
