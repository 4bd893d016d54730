#include "effects/collisions.hpp"

#include "core/make_room.hpp"
#include "core/parallel.hpp"

namespace slod {

void Collisions::reserve(const ClusterTable& clusters, std::size_t member_count)
{
    remaking_.reserve(clusters, member_count, member_count); // each may be alone
    outcomes_.reserve(clusters.slot_capacity());
    make_room(fates_, member_count);
}

void Collisions::fly_members(const UpdateContext& context)
{
    colliders_.set_frame_end(double(context.frame) * context.step);
    const UpdateContext before{context.store, context.frame - 1, context.step};
    remaking_.find(before, [&](std::size_t slot) { return may_be_struck(context, slot); });
    outcomes_.resize(remaking_.mapped().size());
    fates_.resize(remaking_.member_count());
    remaking_.change([&](const Remaking::Mapped& struck, std::span<Particle> members) {
        Outcome& outcome = outcomes_[std::size_t(&struck - remaking_.mapped().data())];
        outcome = fly(context, struck, members);
        return outcome.moved;
    });
}

/// What the cluster in `slot` feels through the frame.
Air::Felt Collisions::felt_by(const UpdateContext& context, std::size_t slot) const
{
    if (air_ == nullptr)
        return {.fields = colliders_.fields()};
    return air_->felt_by_cluster(context.store.clusters, slot);
}

/// By a ball about the centre that no member leaves during the frame, unless it bounces: the map's bound, and
/// drift times the relative velocities. Under kicks the members' ways are bent, and the centre's is not.
bool Collisions::may_be_struck(const UpdateContext& context, std::size_t slot) const
{
    const ClusterTable& clusters = context.store.clusters;
    const auto [radius, velocity] = member_bounds(context.store, slot, context.frame - 1);
    double relative = velocity;
    if (clusters.columns.withheld)
        relative += clusters.withheld[slot].norm();
    const Air::Felt felt = felt_by(context, slot);
    double reach = radius + (air_ == nullptr ? colliders_.frame_drift() * relative
                                             : air_->spread(felt, radius, relative));
    if (clusters.columns.acceleration)
        reach += 0.125 * context.step * context.step * clusters.acceleration[slot].norm();
    reach *= 1 + 1e-5; // the bounds are floats
    return colliders_.may_touch(clusters.position[slot], clusters.velocity[slot], reach, context.step,
                                felt.fields);
}

Collisions::Outcome Collisions::fly(const UpdateContext& context, const Remaking::Mapped& struck,
                                    std::span<Particle> members)
{
    const ClusterTable& clusters = context.store.clusters;
    const std::size_t slot = struck.slot.index;
    // What the kicks give at the ends of the frame acts all through it where something may be hit meanwhile:
    // half of it is taken back, and the other half is yet to come. Without drag free flight is the same
    // either way, up to rounding; with it they differ in third order of the step.
    const Vector3d acceleration =
        clusters.columns.acceleration ? clusters.acceleration[slot] : Vector3d(0, 0, 0);
    const Vector3d half_kick = (0.5 * context.step) * acceleration;
    const Air::Felt felt = felt_by(context, slot);
    Outcome outcome{clusters.position[slot], clusters.velocity[slot]};
    for (std::uint32_t i = 0; i < struck.count; ++i) {
        Particle& member = members[i];
        const Vector3d position = member.position, velocity = member.velocity;
        const UniformFields fields =
            air_ == nullptr ? felt.fields : air_->felt_by_member(felt, position, velocity);
        member.velocity -= half_kick;
        const auto met = colliders_.fly(member.position, member.velocity, context.step, acceleration, fields);
        if (met.killed)
            outcome.killed.add(double(member.mass), member.velocity);
        member.velocity -= half_kick;
        fates_[struck.first + i] = met.killed ? Fate::Killed : met.touched ? Fate::Touching : Fate::Free;
        outcome.touched = outcome.touched || met.touched;
        outcome.moved += member.position != position || member.velocity != velocity ? 1 : 0;
        outcome.impacts += met.impacts;
        outcome.cut_off += met.cut_off ? 1 : 0;
    }
    return outcome;
}

std::uint64_t Collisions::put_back(SlodTree& tree, const UpdateContext& context, CollisionCounts& counts,
                                   Losses& killed)
{
    ClusterTable& clusters = context.store.clusters;
    left_out_ = 0;
    killed = {};
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
        const Remaking::Mapped& struck = remaking_.mapped()[i];
        const Outcome& outcome = outcomes_[i];
        counts.impacts += outcome.impacts;
        counts.impacts_cut_off += outcome.cut_off;
        killed += outcome.killed;
        if (keep(clusters, struck, outcome))
            continue;
        ++counts.taken_apart;
        left_out_ += outcome.killed.particles;
        take_apart(clusters, struck, context.frame);
    }
    counts.struck += outcomes_.size();
    counts.killed += killed.particles;
    remaking_.form(tree, context);
    return left_out_;
}

/// Whether the cluster goes on, which it does where its map carries the members to where they are, where they
/// rest, and where it is a single particle, which is given its outcome if it touched anything.
bool Collisions::keep(ClusterTable& clusters, const Remaking::Mapped& struck, const Outcome& outcome) const
{
    const std::size_t slot = struck.slot.index;
    const bool withheld = clusters.columns.withheld && !clusters.withheld[slot].isZero(0);
    const bool carried = rules_.carries_members || struck.count == 1;
    if (outcome.killed.particles > 0)
        return false;
    const bool free = carried && !outcome.touched && !withheld;
    if (free)
        return true;
    if (struck.count == 1) {
        const Particle& particle = remaking_.members_of(struck).front();
        clusters.position[slot] = particle.position;
        clusters.velocity[slot] = particle.velocity;
        if (withheld)
            clusters.withheld[slot].setZero();
        return true;
    }
    if (withheld)
        return false;
    const bool rests = outcome.moved == 0 && !rules_.full_map && clusters.speed_max[slot] == 0;
    if (rests) {
        clusters.position[slot] = outcome.position;
        clusters.velocity[slot] = outcome.velocity;
    }
    return rests;
}

/// Lets the cluster end, and groups its members: those that touched nothing stay together where the map
/// carries members; the others do where it is exact wherever they go, and else each is alone.
void Collisions::take_apart(const ClusterTable& clusters, const Remaking::Mapped& struck, std::uint64_t frame)
{
    remaking_.end(struck);
    const std::span<const Particle> members = remaking_.members_of(struck);
    for (const Fate fate : {Fate::Free, Fate::Touching}) {
        const bool together = fate == Fate::Touching ? rules_.exact : rules_.carries_members;
        for (std::uint32_t i = 0; i < struck.count; ++i) {
            if (fates_[struck.first + i] != fate)
                continue;
            if (members[i].expiry_frame <= frame) {
                ++left_out_;
                continue;
            }
            remaking_.take(members[i]);
            if (!together)
                remaking_.close_group(clusters, struck);
        }
        remaking_.close_group(clusters, struck);
    }
}

} // namespace slod
