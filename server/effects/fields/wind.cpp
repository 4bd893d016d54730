#include "effects/fields/wind.hpp"

#include <cmath>
#include <numbers>

#include "core/number_text.hpp"
#include "core/portable_math.hpp"

namespace slod {

Problems Wind::problems(const Settings& settings, double)
{
    if (settings.edge <= 0 && !settings.half_extent.array().isInf().all())
        return {"edge = 0 is a jump, which no cluster can follow; use more than 0."};
    if ((settings.half_extent.array() <= 0).any())
        return {"half_extent has a side of 0, which leaves no box; use more than 0 for x, y and z."};
    if (const double shortest = settings.half_extent.minCoeff(); settings.edge > shortest)
        return {"edge = " + number_text(settings.edge) + " is more than the shortest of half_extent, " +
                number_text(shortest) + ", so that the wind blows fully nowhere; use at most that."};
    return {};
}

double Wind::gust(double time) const
{
    const double turns = time / settings_.gust_period;
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    return 1 + settings_.gust_amplitude * portable_sincos(angle).sine;
}

void Wind::add(const Vector3d& x, double time, FieldValue& sum) const
{
    const Vector3d velocity = gust(time) * settings_.velocity;
    const Vector3d d = x - settings_.centre;
    double share = 1;
    Vector3d factor(1, 1, 1), slope(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::isinf(settings_.half_extent[axis]))
            continue;
        const SmoothStep in((settings_.half_extent[axis] - std::abs(d[axis])) / settings_.edge);
        factor[axis] = in.value;
        slope[axis] = (d[axis] > 0 ? -in.slope : in.slope) / settings_.edge;
        share *= in.value;
    }
    sum.value += share * velocity;
    const Vector3d of_share(slope.x() * factor.y() * factor.z(), factor.x() * slope.y() * factor.z(),
                            factor.x() * factor.y() * slope.z());
    sum.gradient += velocity * of_share.transpose();
}

double Wind::clearance(const Vector3d& x) const
{
    const Eigen::Array3d half = settings_.half_extent, within = half - (x - settings_.centre).array().abs();
    if ((within < 0).any())
        return within.min(0).matrix().norm();
    return within.min((within - settings_.edge).abs()).minCoeff();
}

} // namespace slod
