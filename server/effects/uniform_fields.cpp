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
    constexpr const auto& over = inverse_factorials;
    const double x2 = x * x, x4 = x2 * x2;
    const double low = ((over[2] - x * over[3]) + x2 * (over[4] - x * over[5])) +
                       x4 * ((over[6] - x * over[7]) + x2 * (over[8] - x * over[9]));
    return time * time * (low + x4 * x4 * (over[10] - x * over[11]));
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
      drift(drag == 0 ? duration : -decay_minus_1 / drag), fall(drag_fall(drag, duration))
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
