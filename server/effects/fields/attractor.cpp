#include "effects/fields/attractor.hpp"

#include <cmath>

namespace slod {
namespace {

/// Minus the potential of unit strength and its first two derivatives, by the squared distance q.
struct Profile {
    double depth, first, second;
};

Profile profile(double q, const AttractorSettings& settings)
{
    const double softened = q + settings.softening * settings.softening;
    const double inverse = 1 / softened;
    const double f = std::sqrt(inverse), f1 = -0.5 * f * inverse, f2 = -1.5 * f1 * inverse;
    const double edge = 1 / (settings.radius * settings.radius); // 0 without one
    const double left = 1 - q * edge;
    if (left <= 0)
        return {0, 0, 0};
    const double w = left * left * left, w1 = -3 * left * left * edge, w2 = 6 * left * edge * edge;
    return {f * w, f1 * w + f * w1, f2 * w + 2 * f1 * w1 + f * w2};
}

} // namespace

Problems Attractor::problems(const Settings& settings, double)
{
    Problems found;
    if (settings.softening <= 0)
        found.push_back("softening = 0 makes the pull infinite at the attractor; use more than 0.");
    if (settings.radius <= 0)
        found.push_back("radius = 0 leaves nothing to act on; use more than 0, or inf.");
    return found;
}

Box Attractor::bounds() const
{
    const Vector3d reach = Vector3d::Constant(settings_.radius);
    return {settings_.position - reach, settings_.position + reach};
}

void Attractor::add(const Vector3d& x, double, FieldValue& sum) const
{
    const Vector3d d = x - settings_.position;
    const Profile p = profile(d.squaredNorm(), settings_);
    const double along = 2 * settings_.strength * p.first;
    sum.value += along * d;
    sum.gradient += (4 * settings_.strength * p.second) * d * d.transpose();
    sum.gradient.diagonal().array() += along;
}

double Attractor::potential(const Vector3d& x) const
{
    return -settings_.strength * profile((x - settings_.position).squaredNorm(), settings_).depth;
}

} // namespace slod
