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

ConservedQuantities conserved_quantities(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const MappedMoments inner = map_moments(clusters.moments[slot], clusters.blocks(slot, store.rule, frame));
    const double mass = clusters.mass(slot);
    const Vector3d& x = clusters.position[slot];
    const Vector3d v = clusters.mean_velocity(slot);
    // sum of m dx x dv from the off-diagonal differences of sum of m dx dv^T
    const Vector3d spin{inner.cross(1, 2) - inner.cross(2, 1), inner.cross(2, 0) - inner.cross(0, 2),
                        inner.cross(0, 1) - inner.cross(1, 0)};
    return {mass, mass * v, mass * x.cross(v) + spin, 0.5 * (mass * v.squaredNorm() + inner.velocity.trace()),
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
