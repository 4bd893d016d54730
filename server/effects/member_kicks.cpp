#include "effects/member_kicks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/make_room.hpp"
#include "core/parallel.hpp"
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
    return reaches_all() ? particle_count : std::min(particle_count, 2 * members_.size() + 4096);
}

void MemberKicks::reserve(const ClusterTable& clusters, std::size_t member_count)
{
    const std::size_t slots = clusters.slot_capacity();
    make_room(members_, member_count);
    marks_.reserve(slots);
    reached_.reserve(slots);
    ending_.reserve(slots);
    measured_.reserve(slots);
    grouping_.reserve(member_count, slots, slots);
}

MemberKicks::Measured MemberKicks::measured(const ClusterTable& clusters, std::size_t slot)
{
    Measured measured;
    if (clusters.columns.acceleration)
        measured.acceleration = clusters.acceleration[slot];
    if (clusters.columns.tide)
        measured.tide = clusters.tide[slot];
    if (clusters.columns.turning)
        measured.turning = clusters.turning[slot];
    if (clusters.columns.variance())
        measured.variance = clusters.variance[slot];
    return measured;
}

void MemberKicks::write(ClusterTable& clusters, std::size_t slot, const Measured& measured)
{
    if (clusters.columns.acceleration)
        clusters.acceleration[slot] = measured.acceleration;
    if (clusters.columns.tide)
        clusters.tide[slot] = measured.tide;
    if (clusters.columns.turning)
        clusters.turning[slot] = measured.turning;
    if (clusters.columns.variance())
        clusters.variance[slot] = measured.variance;
}

void MemberKicks::update(SlodTree& tree, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    find(context);
    for_each_block(reached_.size(), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Reached& reached = reached_[i];
            const auto members = std::span(members_).subspan(reached.first, reached.count);
            map_out(context.store, reached.slot, context.frame, members);
            for (Particle& member : members)
                reached.changed += kick(member, context.frame, context.step) ? 1 : 0;
        }
    });
    gather(clusters);
    if (ending_.empty())
        return;
    end_clusters(tree, ending_, context);
    form_groups_in_order(grouping_, context);
    for (std::size_t group = 0; group < grouping_.groups.size(); ++group)
        write(clusters, grouping_.slots[grouping_.groups[group].first_slot].index, measured_[group]);
    link_where_they_are(tree, grouping_, context);
}

/// Those with a member that may be too fast, by the bound on velocities, which is a float.
void MemberKicks::find(const UpdateContext& context)
{
    const ClusterTable& clusters = context.store.clusters;
    marks_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            marks_[slot] = clusters.alive(slot) ? 1 : 0;
            if (marks_[slot] == 0 || reaches_all())
                continue;
            const double relative = velocity_bound(clusters, context.store.rule, slot, context.frame);
            marks_[slot] = clusters.mean_velocity(slot).norm() + relative * (1 + 1e-5) > limit_ ? 1 : 0;
        }
    });
    reached_.clear();
    std::uint32_t total = 0;
    for (std::uint32_t slot = 0; slot < marks_.size(); ++slot) {
        if (marks_[slot] == 0)
            continue;
        reached_.push_back({.slot = {slot}, .first = total, .count = clusters.count[slot]});
        total += clusters.count[slot];
    }
    members_.resize(total);
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

/// Single particles are given their new velocity; members of other clusters that changed are grouped, one
/// group for each, which keeps the room that its cluster had for strays.
void MemberKicks::gather(ClusterTable& clusters)
{
    grouping_.clear();
    ending_.clear();
    measured_.clear();
    changed_ = 0;
    for (const Reached& reached : reached_) {
        const std::size_t slot = reached.slot.index;
        changed_ += reached.changed;
        if (reached.changed == 0)
            continue;
        if (reached.count == 1) {
            clusters.velocity[slot] = members_[reached.first].velocity;
            if (clusters.columns.withheld)
                clusters.withheld[slot].setZero();
            continue;
        }
        ending_.push_back(reached.slot);
        measured_.push_back(measured(clusters, slot));
        const auto first = std::uint32_t(grouping_.particles.size());
        const float pull = clusters.columns.acceleration ? float(clusters.pull[slot]) : 0;
        for (std::uint32_t i = reached.first; i < reached.first + reached.count; ++i) {
            grouping_.particles.push_back(members_[i]);
            grouping_.place.push_back(members_[i].position);
            grouping_.pull.push_back(pull);
        }
        grouping_.groups.push_back({.pool = {clusters.region[slot], clusters.pool[slot]},
                                    .first = first,
                                    .count = reached.count,
                                    .clusters = 1,
                                    .spare_rows = clusters.slab[slot].capacity - reached.count});
    }
}

} // namespace slod
