#include "effects/draining.hpp"

#include "cluster/bounds.hpp"
#include "core/make_room.hpp"
#include "core/parallel.hpp"

namespace slod {

void Draining::reserve(const ClusterTable& clusters, std::size_t member_count)
{
    remaking_.reserve(clusters, member_count);
    if (!sinks_.thin())
        return;
    past_.reserve(clusters.slot_capacity());
    make_room(places_, member_count);
}

void Draining::remember(const UpdateContext& context)
{
    if (!sinks_.thin())
        return;
    const ClusterTable& clusters = context.store.clusters;
    past_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot)
            if (clusters.alive(slot))
                past_[slot] = {past_of(clusters, slot),
                               generous_bounds(context.store, slot, context.frame - 1).radius};
    });
}

/// Whether the cluster is the one that was there when the frame began.
bool Draining::remembers(const ClusterTable& clusters, std::size_t slot) const
{
    return slot < past_.size() && past_[slot].cluster.formation == clusters.formation[slot];
}

Losses Draining::update(SlodTree& tree, const UpdateContext& context)
{
    remaking_.find(context, [&](std::size_t slot) { return may_meet_one(context, slot); });
    if (sinks_.thin())
        places_.resize(remaking_.member_count());
    remaking_.change([&](const Remaking::Mapped& mapped, std::span<Particle> members) {
        return drain(context, mapped, members);
    });
    Losses drained;
    for (const Remaking::Mapped& mapped : remaking_.mapped()) {
        if (mapped.changed == 0)
            continue;
        for (const Particle& member : remaking_.members_of(mapped))
            if (member.expiry_frame <= context.frame)
                drained.add(double(member.mass), member.velocity);
        remaking_.remake(mapped, context);
    }
    remaking_.form(tree, context);
    return drained;
}

/// By a ball that no member leaves from the frame's start to its end, first a quick one. Radii are floats,
/// and places far from the origin are rounded.
bool Draining::may_meet_one(const UpdateContext& context, std::size_t slot) const
{
    const ClusterTable& clusters = context.store.clusters;
    Vector3d centre = clusters.position[slot];
    double before = 0, half_way = 0;
    if (remembers(clusters, slot)) {
        const Vector3d back = 0.5 * (past_[slot].cluster.position - centre);
        before = past_[slot].radius;
        half_way = back.norm();
        centre += back;
    }
    const auto reach = [&](double now) {
        const double radius = (std::max(now, before) + half_way) * (1 + 1e-5);
        return sinks_.reach(centre, radius + 1e-15 * centre.cwiseAbs().maxCoeff());
    };
    return reach(generous_bounds(context.store, slot, context.frame).radius) &&
           reach(bounding_radius(clusters, context.store.rule, slot, context.frame));
}

/// Lets those of the members die that meet a sink; returns how many.
std::uint32_t Draining::drain(const UpdateContext& context, const Remaking::Mapped& mapped,
                              std::span<Particle> members)
{
    const std::size_t slot = mapped.slot.index;
    const bool remembered = remembers(context.store.clusters, slot);
    std::span<const Vector3d> before;
    if (remembered) {
        const auto places = std::span(places_).subspan(mapped.first, mapped.count);
        map_out_past(context.store, mapped.slot, context.frame, past_[slot].cluster, places);
        before = places;
    }
    std::uint32_t died = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Vector3d& now = members[i].position;
        if (remembered ? sinks_.meet(before[i], now) : sinks_.hold(now)) {
            members[i].expiry_frame = std::uint32_t(context.frame);
            ++died;
        }
    }
    return died;
}

} // namespace slod
