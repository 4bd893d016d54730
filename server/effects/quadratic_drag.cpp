#include "effects/quadratic_drag.hpp"

#include <algorithm>
#include <cmath>

#include "cluster/flow_map.hpp"
#include "core/portable_math.hpp"
#include "effects/uniform_fields.hpp"

namespace slod {
namespace {

/// The integral of k2 w over the time, w the speed, and its derivatives by the first speed and by a.
struct Path {
    double total, by_speed, by_pull;
};

/// Pulled ahead: k2 w = y'/y with y'' + k1 y' = a k2 y. Written with exponentials that only decay.
Path falling(double k1, double k2, double speed, double pull, double time)
{
    const double half = 0.5 * k1;
    const double root = std::sqrt(half * half + pull * k2);
    const double drift = drag_drift(2 * root, time);
    const double excess = k2 * speed + half - root;
    const double whole = 1 + excess * drift;
    Path path;
    path.total = (root - half) * time + portable_log(whole);
    path.by_speed = k2 * drift / whole;
    if (root * time < 1e-4) // the limit: the difference below would cancel
        path.by_pull = 0.5 * k2 * time * time * (1 + k2 * speed * time / 3) / (1 + k2 * speed * time);
    else {
        const double drift_slope = 2 * (drag_fall(2 * root, time) - time * drift);
        path.by_pull = 0.5 * k2 / root * (time + (excess * drift_slope - drift) / whole);
    }
    return path;
}

/// Held back: the way flown under linear drag alone, up to where it stops.
Path rising(double k1, double k2, double speed, double pull, double time)
{
    const double ratio = speed / -pull;
    const double stop = k1 * ratio < 1e-9 ? ratio : portable_log(1 + k1 * ratio) / k1;
    const double flown = std::min(time, stop);
    const double drift = drag_drift(k1, flown), fall = drag_fall(k1, flown);
    const double whole = 1 + k2 * std::max(speed * drift + pull * fall, 0.0);
    return {portable_log(whole), k2 * drift / whole, k2 * fall / whole};
}

} // namespace

MeanDrag mean_drag(double linear, double quadratic, const Vector3d& relative, const Vector3d& gravity,
                   double time)
{
    if (quadratic == 0 || !(time > 0))
        return {linear + quadratic * relative.norm(), {0, 0, 0}};
    const double speed = relative.norm();
    const double weight = gravity.norm();
    // What is at rest falls straight.
    const Vector3d ahead = speed > 0 ? Vector3d(relative / speed) : Vector3d(0, 0, 0);
    const double pull = speed > 0 ? gravity.dot(ahead) : weight;
    const Path path = pull >= 0 ? falling(linear, quadratic, speed, pull, time)
                                : rising(linear, quadratic, speed, pull, time);
    // Directions turn within the frame where the speed is below what gravity gives in one.
    const double least = std::max(speed, weight * time);
    const Vector3d turning = least > 0 ? Vector3d((gravity - pull * ahead) / least) : Vector3d(0, 0, 0);
    return {linear + path.total / time, (path.by_speed * ahead + path.by_pull * turning) / time};
}

} // namespace slod
