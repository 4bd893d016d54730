#include "effects/sweep.hpp"

#include <algorithm>
#include <utility>

namespace slod {

Sweep::Sweep(const Vector3d& from, const Vector3d& to, const Vector3d& margin)
    : from_(from), margin_(margin),
      inverse_((to - from).cwiseInverse()), bounds_{from.cwiseMin(to) - margin, from.cwiseMax(to) + margin}
{}

/// The shares of the way between each pair of sides must have some in common (Kay and Kajiya 1986). Where the
/// way does not follow an axis, the bounds have answered for it.
bool Sweep::meets(const Box& box) const
{
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (bounds_.upper[axis] < box.lower[axis] || bounds_.lower[axis] > box.upper[axis])
            return false;
        const double lower = (box.lower[axis] - margin_[axis] - from_[axis]) * inverse_[axis];
        const double upper = (box.upper[axis] + margin_[axis] - from_[axis]) * inverse_[axis];
        if (lower != lower || upper != upper)
            continue;
        enter = std::max(enter, std::min(lower, upper));
        leave = std::min(leave, std::max(lower, upper));
    }
    constexpr double rounding = 1e-14; // some fifty of a share
    return enter <= leave + rounding;
}

} // namespace slod
