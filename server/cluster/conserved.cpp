#include "cluster/conserved.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "core/parallel.hpp"

namespace slod {

ConservedQuantities& ConservedQuantities::operator+=(const ConservedQuantities& other)
{
    mass += other.mass;
    momentum += other.momentum;
    angular_momentum += other.angular_momentum;
    kinetic_energy += other.kinetic_energy;
    mass_moment += other.mass_moment;
    return *this;
}

namespace {

InnerMotion inner_motion_of(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    if (clusters.count[slot] == 1)
        return {};
    const MapBlocks map = clusters.blocks(slot, store.rule, frame);
    return store.rule.kind == MapKind::Full ? inner_motion(clusters.moments[slot], map)
                                            : scalar_inner_motion(clusters.moments[slot], map);
}

} // namespace

ConservedQuantities conserved_quantities(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const InnerMotion inner = inner_motion_of(store, slot, frame);
    const double mass = clusters.mass(slot);
    const Vector3d& x = clusters.position[slot];
    const Vector3d v = clusters.mean_velocity(slot);
    return {mass, mass * v, mass * x.cross(v) + inner.spin, 0.5 * (mass * v.squaredNorm() + inner.square),
            mass * x};
}

ConservedQuantities conserved_quantities(const ClusterStore& store, std::uint64_t frame)
{
    constexpr std::size_t most_blocks = 64;
    const std::size_t slots = store.clusters.slot_count();
    const std::size_t block = std::max<std::size_t>(1024, block_count(slots, most_blocks));
    std::array<ConservedQuantities, most_blocks> sums;
    for_each_block(slots, block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot)
            if (store.clusters.alive(slot))
                sums[first / block] += conserved_quantities(store, slot, frame);
    });
    ConservedQuantities total;
    for (const ConservedQuantities& sum : sums)
        total += sum;
    return total;
}

} // namespace slod
