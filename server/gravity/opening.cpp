#include "gravity/opening.hpp"

#include <algorithm>

namespace slod {

Opening::Opening(const ForceView& view, const TargetRun& group, const GravitySettings& gravity,
                 double gravitational_constant, double pull)
    : lower_(view.position(group.first)), upper_(lower_),
      angle_squared_(std::min(gravity.opening_angle, guard) * std::min(gravity.opening_angle, guard)),
      relative_(gravity.opening == OpeningCriterion::Relative && pull > 0),
      allowed_(gravity.force_tolerance * pull / gravitational_constant)
{
    for (std::uint32_t body = group.first; body < group.last; ++body) {
        lower_ = lower_.cwiseMin(view.position(body));
        upper_ = upper_.cwiseMax(view.position(body));
    }
}

} // namespace slod
