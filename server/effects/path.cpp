#include "effects/path.hpp"

#include <algorithm>

#include "core/portable_math.hpp"
#include "effects/uniform_fields.hpp"

namespace slod {
namespace {

/// Planes, and steps to each. A grazing path halves its distance with each; others double their digits.
constexpr int most_steps = 64;

/// Height above a plane over time. Its curvature has one sign, that of `bend`, as it decays with the drag.
struct Descent {
    double gap, speed, pull, drag;

    double bend() const { return pull - drag * speed; }
    double height(const Elapsed& elapsed) const { return gap + elapsed.drift * speed + elapsed.fall * pull; }
    double rate(const Elapsed& elapsed) const { return speed + elapsed.drift * bend(); }
};

/// When the height falls below 0, at most `limit` from now. Newton's steps come from the side where the curve
/// is on the near side of its tangents, so that none passes the root.
double crossing(const Descent& descent, const Elapsed& limit)
{
    if (descent.bend() >= 0) {
        Elapsed now;
        for (int step = 0; step < most_steps; ++step) {
            const double rate = descent.rate(now);
            if (rate >= 0)
                return never; // lowest there, and still above
            const double next = now.time - descent.height(now) / rate;
            if (next > limit.time)
                return never;
            if (next <= now.time)
                break;
            now = Elapsed(descent.drag, next);
        }
        return now.time;
    }
    Elapsed now = limit;
    if (descent.height(now) >= 0)
        return never;
    for (int step = 0; step < most_steps; ++step) {
        const double next = now.time - descent.height(now) / descent.rate(now);
        if (!(next < now.time))
            break;
        now = Elapsed(descent.drag, next);
    }
    return std::max(now.time, 0.0);
}

/// When a path that goes on from `now` crosses one of the cover's limits; never when it does not by `limit`.
double uncovered(const Path& path, const Cover& cover, const Elapsed& now, const Elapsed& limit)
{
    const Elapsed left(path.drag, limit.time - now.time);
    const Vector3d velocity = path.velocity_after(now);
    double first = never;
    for (int i = 0; i < cover.count; ++i) {
        const Cover::Limit& each = cover.limits[std::size_t(i)];
        const Descent descent{each.height, each.inward.dot(velocity), each.inward.dot(path.acceleration),
                              path.drag};
        first = std::min(first, now.time + crossing(descent, left));
    }
    return first;
}

} // namespace

Elapsed::Elapsed(double drag, double duration)
    : time(duration), drift(duration), fall(drag_fall(drag, duration))
{
    if (drag == 0)
        return;
    const double decay_minus_1 = portable_expm1(-drag * duration);
    decay = 1 + decay_minus_1;
    drift = -decay_minus_1 / drag;
}

/// A curve strays from its chord by an eighth of its largest second derivative times the time squared; the
/// second derivative is largest at the start.
Vector3d Path::stray(const Elapsed& elapsed) const
{
    const Vector3d bend = acceleration - drag * velocity;
    return (0.125 * elapsed.time * elapsed.time) * bend.cwiseAbs();
}

Box Path::bounds(const Elapsed& elapsed) const
{
    const Vector3d end = position_after(elapsed), off = stray(elapsed);
    return {position.cwiseMin(end) - off, position.cwiseMax(end) + off};
}

Sweep Path::sweep(const Elapsed& elapsed, double reach) const
{
    return {position, position_after(elapsed), stray(elapsed).array() + reach};
}

double first_contact(const Path& path, const Solid& solid, double reach, const Elapsed& limit, bool leaving)
{
    Elapsed now;
    for (int step = 0; step < most_steps; ++step) {
        const Vector3d position = path.position_after(now);
        const Surface surface = solid.surface(position);
        double gap = surface.distance - reach;
        double speed = surface.normal.dot(path.velocity_after(now));
        if (leaving && step == 0) {
            gap = std::max(gap, 0.0);
            speed = std::max(speed, 0.0);
        } else if (gap <= contact_tolerance(position)) {
            const Cover cover = reach == 0 ? solid.cover(position) : Cover{};
            const double next = cover.count > 0 ? uncovered(path, cover, now, limit) : now.time;
            if (next == now.time || next > limit.time)
                return next <= limit.time ? next : never;
            now = Elapsed(path.drag, next);
            continue;
        }
        const Descent descent{gap, speed, surface.normal.dot(path.acceleration), path.drag};
        const double next =
            now.time + crossing(descent, step == 0 ? limit : Elapsed(path.drag, limit.time - now.time));
        if (next > limit.time)
            return never;
        if (next <= now.time && step > 0)
            return now.time;
        now = Elapsed(path.drag, next);
    }
    return now.time;
}

double contact_tolerance(const Vector3d& position)
{
    return 1e-14 * position.cwiseAbs().maxCoeff();
}

} // namespace slod
