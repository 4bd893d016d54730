#include "effects/member_kicks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cluster/bounds.hpp"
#include "core/random.hpp"

namespace slod {
namespace {

constexpr std::uint32_t stream = 0xffff'0002; ///< of random numbers: no emitter's

/// Generators of one particle in different frames differ in the key.
std::uint64_t key_of(std::uint64_t seed, std::uint64_t frame)
{
    return seed + frame * 0x9e37'79b9'7f4a'7c15;
}

} // namespace

MemberKicks::MemberKicks(const std::optional<SpeedLimitSettings>& limit,
                         const std::optional<BrownianSettings>& brownian, std::uint64_t seed)
    : limit_(limit ? limit->speed : std::numeric_limits<double>::infinity()),
      strength_(brownian ? brownian->strength : 0), seed_(seed)
{}

std::size_t MemberKicks::expected_members(std::size_t particle_count) const
{
    return reaches_all() ? particle_count : remaking_.expected_members(particle_count);
}

void MemberKicks::update(SlodTree& tree, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    remaking_.find(context,
                   [&](std::size_t slot) { return reaches_all() || may_be_too_fast(context, slot); });
    remaking_.change([&](const Remaking::Mapped&, std::span<Particle> members) {
        return std::uint32_t(std::count_if(members.begin(), members.end(), [&](Particle& member) {
            return kick(member, context.frame, context.step);
        }));
    });
    changed_ = 0;
    for (const Remaking::Mapped& mapped : remaking_.mapped()) {
        changed_ += mapped.changed;
        if (mapped.changed == 0)
            continue;
        if (mapped.count > 1) {
            remaking_.remake(mapped, context);
            continue;
        }
        const std::size_t slot = mapped.slot.index; // a single particle is given its new velocity
        clusters.velocity[slot] = remaking_.members_of(mapped).front().velocity;
        if (clusters.columns.withheld)
            clusters.withheld[slot].setZero();
    }
    remaking_.form(tree, context);
}

/// By the bound on its members' velocities, which is a float.
bool MemberKicks::may_be_too_fast(const UpdateContext& context, std::size_t slot) const
{
    const ClusterTable& clusters = context.store.clusters;
    const double relative = velocity_bound(clusters, context.store.rule, slot, context.frame);
    return clusters.mean_velocity(slot).norm() + relative * (1 + 1e-5) > limit_;
}

/// Kicks of uniform components with the variance of normal ones: what they come to over some frames is normal
/// (Kloeden and Platen 1992, 14.2). Returns whether the velocity changed.
bool MemberKicks::kick(Particle& particle, std::uint64_t frame, double step) const
{
    const Vector3d before = particle.velocity;
    if (strength_ > 0) {
        Random random(key_of(seed_, frame), stream, particle.id);
        const double half_width = strength_ * std::sqrt(3 * step);
        for (int axis = 0; axis < 3; ++axis)
            particle.velocity[axis] += half_width * (2 * random.uniform() - 1);
    }
    if (const double speed = particle.velocity.norm(); speed > limit_)
        particle.velocity *= limit_ / speed;
    return particle.velocity != before;
}

} // namespace slod
