#include "tree/merge_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.hpp"

namespace slod {
namespace {

/// Position moments of both together, every particle weighing the same.
Symmetric3 union_moments(const ClusterStore& store, std::size_t a, std::size_t b, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const auto own = [&](std::size_t slot) {
        return map_position_moments(clusters.counting_moments(slot), clusters.blocks(slot, store.rule, frame))
            .matrix();
    };
    const auto na = double(clusters.count[a]);
    const auto nb = double(clusters.count[b]);
    const Vector3d apart = clusters.position[b] - clusters.position[a];
    return Symmetric3::of(own(a) + own(b) + (na * nb / (na + nb)) * apart * apart.transpose());
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

bool wider_than(double limit, const Symmetric3& second_moments, double size)
{
    // The largest principal variance is between a third of the trace and the whole of it.
    const double squared = 20 * second_moments.trace() / size;
    if (squared <= limit * limit)
        return false;
    return squared > 3 * limit * limit || breadth(second_moments, size) > limit;
}

} // namespace slod
