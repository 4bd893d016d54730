#include "effects/fields/vortex.hpp"

namespace slod {

Problems Vortex::problems(const Settings& settings, double)
{
    Problems found;
    if (settings.axis.isZero(0))
        found.push_back("axis = [0, 0, 0] is none; give the line's direction, such as [0, 0, 1].");
    if (settings.core_radius <= 0)
        found.push_back("core_radius = 0 makes the acceleration infinite on the line; use more than 0.");
    return found;
}

Vortex::Vortex(const Settings& settings, const FieldSource&) : settings_(settings)
{
    const Vector3d n = settings.axis.stableNormalized();
    turn_ << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
}

void Vortex::add(const Vector3d& x, double, FieldValue& sum) const
{
    const Vector3d about = turn_ * (x - settings_.position);
    const double inverse = 1 / (about.squaredNorm() + settings_.core_radius * settings_.core_radius);
    const double rate = settings_.strength * inverse;
    // about^2 grows by 2 (turn^T about) d: the distance from the line, outwards.
    const Vector3d growth = 2 * turn_.transpose() * about;
    sum.value += rate * about;
    sum.gradient += rate * turn_ - (rate * inverse) * about * growth.transpose();
}

} // namespace slod
