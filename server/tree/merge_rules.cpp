#include "tree/merge_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "cluster/bounds.hpp"
#include "core/portable_math.hpp"

namespace slod {
namespace {

/// A direction in a plane; products of them add angles.
struct Turn {
    double cosine, sine;

    Turn operator*(const Turn& other) const
    {
        return {cosine * other.cosine - sine * other.sine, sine * other.cosine + cosine * other.sine};
    }
};

/// Half the angle under which the ball is seen from zero velocity, which is outside of it.
Turn half_angle(const VelocityBall& ball)
{
    const double sine = ball.radius / ball.speed;
    return {std::sqrt(1 - sine * sine), sine};
}

Turn between(const Vector3d& a, const Vector3d& b)
{
    const double product = a.norm() * b.norm();
    return {a.dot(b) / product, a.cross(b).norm() / product};
}

/// Ten roundings are between two parallel velocities and the cosine of the angle between them: of their
/// product three, of their lengths five, of the product of those and the quotient two.
constexpr double cosine_rounding = 10 * 0x1p-53;

/// Of `size` times the largest principal variance, for a cluster no wider than `limit`.
double largest_variance_sum(double limit, double size)
{
    return limit * limit * size / 20;
}

/// Breadth that a cluster of so many particles may have for now.
double breadth_goal(const RegionSettings& region, std::uint32_t size)
{
    constexpr double nearly_full = 0.9, excess = 1.25;
    const bool full = size > nearly_full * std::uint32_t(region.max_cluster_size);
    return full ? excess * region.max_breadth : region.max_breadth;
}

} // namespace

VelocityBall velocity_ball(const ClusterStore& store, std::size_t slot, std::uint64_t frame,
                           const Vector3d& reference)
{
    const Vector3d mean = store.clusters.mean_velocity(slot) - reference;
    return {mean, mean.norm(), velocity_bound(store.clusters, store.rule, slot, frame)};
}

VelocityBall enclosing_ball(const VelocityBall& a, const VelocityBall& b)
{
    const Vector3d apart = b.mean - a.mean;
    const double distance = apart.norm();
    if (distance + b.radius <= a.radius)
        return a;
    if (distance + a.radius <= b.radius)
        return b;
    const double radius = (distance + a.radius + b.radius) / 2;
    const Vector3d mean = distance > 0 ? a.mean + (radius - a.radius) / distance * apart : a.mean;
    return {mean, mean.norm(), radius};
}

Crowd crowd_of(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const MapBlocks map = clusters.blocks(slot, store.rule, frame);
    const Moments& count = clusters.counting_moments(slot);
    const Moments& mass = clusters.mass(slot) > 0 ? clusters.moments[slot] : count;
    const Vector3d off_centre = map.a * (count.mean_offset() - mass.mean_offset()) +
                                map.b * (count.mean_velocity() - mass.mean_velocity());
    const auto number = double(clusters.count[slot]);
    return {number, clusters.position[slot] + off_centre,
            number / count.weight * map_position_moments(count, map).matrix()};
}

Crowd operator+(const Crowd& a, const Crowd& b)
{
    const Vector3d apart = b.centre - a.centre;
    const double number = a.number + b.number;
    return {number, a.centre + b.number / number * apart,
            a.moments + b.moments + a.number * b.number / number * apart * apart.transpose()};
}

MergeRules::MergeRules(const RegionSettings& region)
    : region_(region), least_cosine_(portable_sincos(region.angle_deg * std::numbers::pi / 180).cosine)
{}

bool MergeRules::move_alike(const VelocityBall& a, const VelocityBall& b) const
{
    const double fastest = std::max(a.speed + a.radius, b.speed + b.radius);
    const double slowest = std::min(a.speed - a.radius, b.speed - b.radius);
    if (fastest <= region_.speed_floor)
        return true;
    if (slowest <= 0 || fastest > region_.speed_ratio * slowest)
        return false;
    if (region_.angle_deg >= 180)
        return true;
    const Turn widest = between(a.mean, b.mean) * half_angle(a) * half_angle(b);
    return widest.sine >= 0 &&
           widest.cosine >= least_cosine_ - cosine_rounding; // below 0: more than half a turn
}

bool MergeRules::limit_breadth() const
{
    return std::isfinite(region_.max_breadth);
}

bool MergeRules::fit(const Crowd& crowd, std::uint32_t parts) const
{
    // A part has no more than all of the scatter about the centre, and 1 / parts of the particles.
    const double limit =
        breadth_goal(region_, std::uint32_t(crowd.number) / parts) / std::sqrt(double(parts));
    return !wider_than(limit, Symmetric3::of(crowd.moments), crowd.number);
}

bool moves_alike(const ClusterStore& store, const RegionSettings& region, ClusterSlot slot,
                 std::uint64_t frame, const Vector3d& reference)
{
    const VelocityBall ball = velocity_ball(store, slot.index, frame, reference);
    return MergeRules(region).move_alike(ball, ball);
}

bool too_wide(const ClusterStore& store, const RegionSettings& region, ClusterSlot slot, std::uint64_t frame)
{
    constexpr std::uint64_t excess_frames = 60;
    const ClusterTable& clusters = store.clusters;
    const std::uint32_t count = clusters.count[slot.index];
    const std::uint64_t age = frame - clusters.formed_frame[slot.index];
    if (count < 2)
        return false;
    if (store.rule.kind == MapKind::Identity && std::isfinite(region.drift_limit) &&
        double(age) * store.rule.step * velocity_bound(clusters, store.rule, slot.index, frame) >
            region.drift_limit)
        return true;
    if (!std::isfinite(region.max_breadth))
        return false;
    const double limit = age < excess_frames ? breadth_goal(region, count) : region.max_breadth;
    if (store.rule.kind != MapKind::Full) { // most clusters are nowhere near their limit
        const double radius = generous_bounds(store, slot.index, frame).radius * (1 + 1e-5); // of floats
        if (radius * radius <= largest_variance_sum(limit, 1))
            return false;
    }
    const Moments& moments = clusters.counting_moments(slot.index);
    if (store.rule.kind == MapKind::Scalar) {
        const double trace = streamed_trace(moments, store.drift(age));
        if (trace * (1 + 1e-9) <= largest_variance_sum(limit, moments.weight))
            return false;
    }
    const Symmetric3 extent = map_position_moments(moments, clusters.blocks(slot.index, store.rule, frame));
    return wider_than(limit, extent, moments.weight);
}

bool wider_than(double limit, const Symmetric3& sum, double size)
{
    // The largest principal variance is between a third of the trace and the whole of it.
    const double most = largest_variance_sum(limit, size);
    if (sum.trace() <= most)
        return false;
    if (sum.trace() > 3 * most)
        return true;
    // It is above `most` just if most 1 - sum, by elimination, has a negative pivot.
    const double first = most - sum.xx;
    if (first <= 0)
        return true;
    const double second = most - sum.yy - sum.xy * sum.xy / first;
    if (second <= 0)
        return true;
    const double across = sum.yz + sum.xy * sum.xz / first;
    return most - sum.zz - sum.xz * sum.xz / first - across * across / second < 0;
}

} // namespace slod
