#include "effects/collisions.hpp"

#include "core/make_room.hpp"
#include "core/parallel.hpp"

namespace slod {

void Collisions::reserve(const ClusterTable& clusters, std::size_t member_count)
{
    const std::size_t slots = clusters.slot_capacity();
    make_room(members_, member_count);
    make_room(fates_, member_count);
    marks_.reserve(slots);
    struck_.reserve(slots);
    ending_.reserve(slots);
    make_room(measured_, member_count);
    grouping_.reserve(member_count, 2 * slots, slots);
}

void Collisions::fly_members(const UpdateContext& context)
{
    const ClusterTable& clusters = context.store.clusters;
    colliders_.set_frame_end(double(context.frame) * context.step);
    marks_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot)
            marks_[slot] = clusters.alive(slot) && may_be_struck(context, slot) ? 1 : 0;
    });
    struck_.clear();
    std::uint32_t total = 0;
    for (std::uint32_t slot = 0; slot < marks_.size(); ++slot) {
        if (marks_[slot] == 0)
            continue;
        struck_.push_back({.slot = {slot},
                           .first = total,
                           .count = clusters.count[slot],
                           .position = clusters.position[slot],
                           .velocity = clusters.velocity[slot]});
        total += clusters.count[slot];
    }
    members_.resize(total);
    fates_.resize(total);
    for_each_block(struck_.size(), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            fly(context, struck_[i]);
    });
}

/// What the cluster in `slot` feels through the frame.
Air::Felt Collisions::felt_by(const UpdateContext& context, std::size_t slot) const
{
    if (air_ == nullptr)
        return {.fields = colliders_.fields()};
    const ClusterTable& clusters = context.store.clusters;
    return air_->felt(clusters.position[slot], clusters.velocity[slot],
                      double(context.frame - 1) * context.step, context.step);
}

/// By a ball about the centre that no member leaves during the frame, unless it bounces: the map's bound, and
/// drift times the relative velocities. Under kicks the members' ways are bent, and the centre's is not.
bool Collisions::may_be_struck(const UpdateContext& context, std::size_t slot) const
{
    const ClusterTable& clusters = context.store.clusters;
    const MapRule& rule = context.store.rule;
    const std::uint64_t start = context.frame - 1;
    double relative = velocity_bound(clusters, rule, slot, start);
    if (clusters.columns.withheld)
        relative += clusters.withheld[slot].norm();
    const double radius = bounding_radius(clusters, rule, slot, start);
    const Air::Felt felt = felt_by(context, slot);
    double reach = radius + (air_ == nullptr ? drag_drift(rule.drag, context.step) * relative
                                             : air_->spread(felt, radius, relative));
    if (clusters.columns.acceleration)
        reach += 0.125 * context.step * context.step * clusters.acceleration[slot].norm();
    reach *= 1 + 1e-5; // the bounds are floats
    return colliders_.may_touch(clusters.position[slot], clusters.velocity[slot], reach, context.step,
                                felt.fields);
}

void Collisions::fly(const UpdateContext& context, Struck& struck)
{
    const ClusterTable& clusters = context.store.clusters;
    const std::span<Particle> members = std::span(members_).subspan(struck.first, struck.count);
    map_out(context.store, struck.slot, context.frame - 1, members);
    // What the kicks give at the ends of the frame acts all through it where something may be hit meanwhile:
    // half of it is taken back, and the other half is yet to come. Without drag free flight is the same
    // either way, up to rounding; with it they differ in third order of the step.
    const Vector3d acceleration =
        clusters.columns.acceleration ? clusters.acceleration[struck.slot.index] : Vector3d(0, 0, 0);
    const Vector3d half_kick = (0.5 * context.step) * acceleration;
    const Air::Felt felt = felt_by(context, struck.slot.index);
    for (std::uint32_t i = 0; i < struck.count; ++i) {
        Particle& member = members[i];
        const Vector3d position = member.position, velocity = member.velocity;
        const UniformFields fields =
            air_ == nullptr ? felt.fields : air_->felt_by_member(felt, position, velocity);
        member.velocity -= half_kick;
        const auto met = colliders_.fly(member.position, member.velocity, context.step, acceleration, fields);
        member.velocity -= half_kick;
        fates_[struck.first + i] = met.killed ? Fate::Killed : met.touched ? Fate::Touching : Fate::Free;
        struck.touched = struck.touched || met.touched;
        struck.moved = struck.moved || member.position != position || member.velocity != velocity;
        struck.impacts += met.impacts;
        struck.cut_off += met.cut_off ? 1 : 0;
        struck.killed += met.killed ? 1 : 0;
    }
}

std::uint64_t Collisions::put_back(SlodTree& tree, const UpdateContext& context, CollisionCounts& counts)
{
    ClusterTable& clusters = context.store.clusters;
    grouping_.clear();
    ending_.clear();
    measured_.clear();
    left_out_ = 0;
    for (const Struck& struck : struck_) {
        counts.impacts += struck.impacts;
        counts.impacts_cut_off += struck.cut_off;
        counts.killed += struck.killed;
        if (!keep(clusters, struck))
            gather(clusters, struck, context.frame);
    }
    counts.struck += struck_.size();
    counts.taken_apart += ending_.size();
    if (ending_.empty())
        return 0;
    end_clusters(tree, ending_, context);
    form_groups_in_order(grouping_, context);
    for (std::size_t group = 0; group < grouping_.groups.size(); ++group)
        set_measured(clusters, grouping_.slots[grouping_.groups[group].first_slot].index, measured_[group]);
    link_where_they_are(tree, grouping_, context);
    return left_out_;
}

/// Whether the cluster goes on, which it does where its map carries the members to where they are, where they
/// rest, and where it is a single particle, which is given its outcome if it touched anything.
bool Collisions::keep(ClusterTable& clusters, const Struck& struck) const
{
    const std::size_t slot = struck.slot.index;
    const bool withheld = clusters.columns.withheld && !clusters.withheld[slot].isZero(0);
    const bool carried = rules_.carries_members || struck.count == 1;
    if (struck.killed > 0)
        return false;
    const bool free = carried && !struck.touched && !withheld;
    if (free)
        return true;
    if (struck.count == 1) {
        clusters.position[slot] = members_[struck.first].position;
        clusters.velocity[slot] = members_[struck.first].velocity;
        if (withheld)
            clusters.withheld[slot].setZero();
        return true;
    }
    if (withheld)
        return false;
    const bool rests = !struck.moved && !rules_.full_map && clusters.speed_max[slot] == 0;
    if (rests) {
        clusters.position[slot] = struck.position;
        clusters.velocity[slot] = struck.velocity;
    }
    return rests;
}

/// Lets the cluster end, and groups its members: those that touched nothing stay together where the map
/// carries members; the others do where it is exact wherever they go, and else each is alone.
void Collisions::gather(const ClusterTable& clusters, const Struck& struck, std::uint64_t frame)
{
    ending_.push_back(struck.slot);
    left_out_ += struck.killed;
    for (const Fate fate : {Fate::Free, Fate::Touching}) {
        const auto first = std::uint32_t(grouping_.particles.size());
        const bool together = fate == Fate::Touching ? rules_.exact : rules_.carries_members;
        for (std::uint32_t i = struck.first; i < struck.first + struck.count; ++i) {
            if (fates_[i] != fate)
                continue;
            if (members_[i].expiry_frame <= frame) {
                ++left_out_;
                continue;
            }
            grouping_.particles.push_back(members_[i]);
            if (!together)
                add_group(clusters, struck, std::uint32_t(grouping_.particles.size() - 1));
        }
        if (together)
            add_group(clusters, struck, first);
    }
}

/// Makes a group, of one cluster, of the particles from `first` on.
void Collisions::add_group(const ClusterTable& clusters, const Struck& struck, std::uint32_t first)
{
    const auto end = std::uint32_t(grouping_.particles.size());
    const std::size_t slot = struck.slot.index;
    if (first == end)
        return;
    for (std::uint32_t i = first; i < end; ++i) {
        grouping_.place.push_back(grouping_.particles[i].position);
        grouping_.pull.push_back(clusters.columns.acceleration ? float(clusters.pull[slot]) : 0);
    }
    measured_.push_back(measured(clusters, slot));
    grouping_.groups.push_back({.pool = {clusters.region[slot], clusters.pool[slot]},
                                .first = first,
                                .count = end - first,
                                .clusters = 1});
}

} // namespace slod
