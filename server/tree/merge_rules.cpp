#include "tree/merge_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.hpp"

namespace slod {
namespace {

/// A cluster as its particles' number and places have it, all weighing the same.
struct Crowd {
    double number;
    Vector3d centre;
    Matrix3d moments;
};

Crowd crowd(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
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

/// Position moments of both together, every particle weighing the same.
Symmetric3 union_moments(const ClusterStore& store, std::size_t a, std::size_t b, std::uint64_t frame)
{
    const Crowd one = crowd(store, a, frame);
    const Crowd other = crowd(store, b, frame);
    const Vector3d apart = other.centre - one.centre;
    const double reduced = one.number * other.number / (one.number + other.number);
    return Symmetric3::of(one.moments + other.moments + reduced * apart * apart.transpose());
}

bool move_alike(const RegionSettings& region, const Vector3d& va, const Vector3d& vb)
{
    const double a = va.norm();
    const double b = vb.norm();
    if (std::max(a, b) <= region.speed_floor)
        return true;
    const double cosine = portable_sincos(region.angle_deg * std::numbers::pi / 180).cosine;
    return std::max(a, b) <= region.speed_ratio * std::min(a, b) && va.dot(vb) >= cosine * a * b;
}

} // namespace

bool may_merge(const ClusterStore& store, const RegionSettings& region, ClusterSlot a, ClusterSlot b,
               std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const std::uint32_t size = clusters.count[a.index] + clusters.count[b.index];
    return size <= std::uint32_t(region.max_cluster_size) &&
           move_alike(region, clusters.velocity[a.index], clusters.velocity[b.index]) &&
           (!std::isfinite(region.max_breadth) ||
            !wider_than(region.max_breadth, union_moments(store, a.index, b.index, frame), size));
}

bool wider_than(double limit, const Symmetric3& sum, double size)
{
    // The largest principal variance is between a third of the trace and the whole of it.
    const double most = limit * limit * size / 20;
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
