#include "effects/remaking.hpp"

#include "core/make_room.hpp"

namespace slod {

void Remaking::reserve(const ClusterTable& clusters, std::size_t member_count, std::size_t group_count)
{
    const std::size_t slots = clusters.slot_capacity();
    make_room(members_, member_count);
    marks_.reserve(slots);
    mapped_.reserve(slots);
    ending_.reserve(slots);
    make_room(measured_, group_count);
    grouping_.reserve(member_count, group_count, slots);
}

/// Begins anew with the clusters that are marked, and room for their members.
void Remaking::list_marked(const ClusterTable& clusters)
{
    mapped_.clear();
    ending_.clear();
    measured_.clear();
    grouping_.clear();
    std::uint32_t total = 0;
    for (std::uint32_t slot = 0; slot < marks_.size(); ++slot) {
        if (marks_[slot] == 0)
            continue;
        mapped_.push_back({.slot = {slot}, .first = total, .count = clusters.count[slot]});
        total += clusters.count[slot];
    }
    members_.resize(total);
}

void Remaking::remake(const Mapped& mapped, const UpdateContext& context)
{
    const ClusterTable& clusters = context.store.clusters;
    end(mapped);
    for (const Particle& member : members_of(mapped))
        if (member.expiry_frame > context.frame)
            take(member);
    close_group(clusters, mapped, clusters.slab[mapped.slot.index].capacity - mapped.count);
}

void Remaking::close_group(const ClusterTable& clusters, const Mapped& mapped, std::uint32_t spare_rows)
{
    const auto first = std::uint32_t(grouping_.place.size()), end = std::uint32_t(grouping_.particles.size());
    if (first == end)
        return;
    const std::size_t slot = mapped.slot.index;
    const float pull = clusters.columns.acceleration ? float(clusters.pull[slot]) : 0;
    for (std::uint32_t i = first; i < end; ++i) {
        grouping_.place.push_back(grouping_.particles[i].position);
        grouping_.pull.push_back(pull);
    }
    measured_.push_back(measured(clusters, slot));
    grouping_.groups.push_back({.pool = {clusters.region[slot], clusters.pool[slot]},
                                .first = first,
                                .count = end - first,
                                .clusters = 1,
                                .spare_rows = spare_rows});
}

void Remaking::form(SlodTree& tree, const UpdateContext& context)
{
    if (ending_.empty())
        return;
    ClusterTable& clusters = context.store.clusters;
    end_clusters(tree, ending_, context);
    form_groups_in_order(grouping_, context);
    for (std::size_t group = 0; group < grouping_.groups.size(); ++group)
        set_measured(clusters, grouping_.slots[grouping_.groups[group].first_slot].index, measured_[group]);
    link_where_they_are(tree, grouping_, context);
}

} // namespace slod
