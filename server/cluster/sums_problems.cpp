#include "cluster/sums_problems.hpp"

#include <cmath>
#include <string>

#include "cluster/bounds.hpp"
#include "cluster/particles.hpp"
#include "core/number_text.hpp"

namespace slod {
namespace {

/// Sums over a cluster's members about its centre and mean velocity.
struct Sums {
    double mass = 0;
    Vector3d position{0, 0, 0}, velocity{0, 0, 0}; ///< by mass, or by number when all are massless
    Matrix3d spread = Matrix3d::Zero();            ///< sum of mass dx dx^T
};

Sums sum_up(const ClusterTable& clusters, std::size_t slot, const ParticleSet& members)
{
    const bool massless = !(clusters.mass(slot) > 0);
    Sums sums;
    for (const Particle& member : members) {
        const double weight = massless ? 1 : double(member.mass);
        const Vector3d away = member.position - clusters.position[slot];
        sums.mass += double(member.mass);
        sums.position += weight * away;
        sums.velocity += weight * (member.velocity - clusters.mean_velocity(slot));
        sums.spread += double(member.mass) * away * away.transpose();
    }
    return sums;
}

/// Each of n terms, and each step of what led to them, is rounded by at most half a unit in the last place of
/// the largest number in it: places and velocities of members in space, not only about their centre. Where
/// that is beyond all numbers, as of squares of what is beyond their roots, nothing can be said.
void check(const ClusterStore& store, std::size_t slot, std::uint64_t frame, const ParticleSet& members,
           Problems& found)
{
    const ClusterTable& clusters = store.clusters;
    const double roundings = (double(members.size()) + 64) * 0x1p-52;
    const double mass = clusters.mass(slot), weight = mass > 0 ? mass : double(members.size());
    const double reach = bounding_radius(clusters, store.rule, slot, frame);
    const double rush = velocity_bound(clusters, store.rule, slot, frame);
    const double far_off = clusters.position[slot].stableNorm() + reach;
    const double fast = clusters.mean_velocity(slot).stableNorm() + rush;
    const Sums sums = sum_up(clusters, slot, members);
    const MappedMoments moments =
        map_moments(clusters.moments[slot], clusters.blocks(slot, store.rule, frame));
    const auto expect = [&](std::string_view what, double difference, double most) {
        if (std::isfinite(most) && !(difference <= roundings * most))
            found.push_back("cluster " + std::to_string(slot) + ": its " + std::string(what) +
                            " is off that of its members by " + number_text(difference / most) +
                            " of the largest there is");
    };
    expect("mass", std::abs(sums.mass - mass), mass);
    expect("centre", sums.position.norm(), weight * far_off);
    expect("velocity", sums.velocity.norm(), weight * fast);
    expect("second moment", (sums.spread - moments.position).norm(), mass * reach * far_off);
}

} // namespace

Problems sums_problems(const ClusterStore& store, std::uint64_t frame)
{
    Problems found;
    ParticleSet members;
    for (std::uint32_t slot = 0; slot < store.clusters.slot_count(); ++slot) {
        if (!store.clusters.alive(slot))
            continue;
        members.resize(store.clusters.count[slot]);
        map_out(store, {slot}, frame, members);
        check(store, slot, frame, members, found);
    }
    return found;
}

} // namespace slod
