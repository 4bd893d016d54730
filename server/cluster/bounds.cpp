#include "cluster/bounds.hpp"

#include <cmath>

namespace slod {
namespace {

/// Bounds the spectral norm from above, and is equal to it for a multiple of the identity.
double norm_bound(const Matrix3d& matrix)
{
    const Matrix3d sizes = matrix.cwiseAbs();
    return std::sqrt(sizes.rowwise().sum().maxCoeff() * sizes.colwise().sum().maxCoeff());
}

/// Largest lengths of o - o_c and w - w_c among the members, from the largest of o and w at forming.
MemberBounds formed_bounds(const ClusterTable& clusters, std::size_t slot)
{
    const MapBlocks::Offset mean = map_centre(clusters, slot);
    return {double(clusters.offset_max[slot]) + mean.position.norm(),
            double(clusters.speed_max[slot]) + mean.velocity.norm()};
}

/// Largest length of `of_offset` o + `of_velocity` w among the members.
double mapped_bound(const MemberBounds& formed, const Matrix3d& of_offset, const Matrix3d& of_velocity)
{
    return norm_bound(of_offset) * formed.radius + norm_bound(of_velocity) * formed.velocity;
}

/// What bounds at forming have become under a map that is a closed form of the age.
MemberBounds carried(const ClusterStore& store, std::size_t slot, std::uint64_t frame,
                     const MemberBounds& formed)
{
    if (store.rule.kind == MapKind::Identity)
        return formed;
    const double drift = store.drift(frame - store.clusters.formed_frame[slot]);
    const double decay = 1 - store.rule.drag * drift;
    return {formed.radius + drift * formed.velocity, decay * formed.velocity};
}

} // namespace

double bounding_radius(const ClusterTable& clusters, const MapRule& rule, std::size_t slot,
                       std::uint64_t frame)
{
    const MapBlocks map = clusters.blocks(slot, rule, frame);
    return mapped_bound(formed_bounds(clusters, slot), map.a, map.b);
}

double velocity_bound(const ClusterTable& clusters, const MapRule& rule, std::size_t slot,
                      std::uint64_t frame)
{
    const MapBlocks map = clusters.blocks(slot, rule, frame);
    return mapped_bound(formed_bounds(clusters, slot), map.c, map.d);
}

MemberBounds member_bounds(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    if (store.rule.kind != MapKind::Full)
        return carried(store, slot, frame, formed_bounds(store.clusters, slot));
    const MemberBounds formed = formed_bounds(store.clusters, slot);
    const MapBlocks map = store.clusters.blocks(slot, store.rule, frame);
    return {mapped_bound(formed, map.a, map.b), mapped_bound(formed, map.c, map.d)};
}

MemberBounds generous_bounds(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    if (store.rule.kind == MapKind::Full)
        return member_bounds(store, slot, frame);
    const ClusterTable& clusters = store.clusters;
    return carried(store, slot, frame,
                   {2 * double(clusters.offset_max[slot]), 2 * double(clusters.speed_max[slot])});
}

} // namespace slod
