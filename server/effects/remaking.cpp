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

void Remaking::begin()
{
    mapped_.clear();
    ending_.clear();
    measured_.clear();
    grouping_.clear();
}

/// Begins anew with the clusters that are marked, and room for their members.
void Remaking::list_marked(const ClusterTable& clusters)
{
    begin();
    std::uint32_t total = 0;
    for (std::uint32_t slot = 0; slot < marks_.size(); ++slot) {
        if (marks_[slot] == 0)
            continue;
        mapped_.push_back({.slot = {slot}, .first = total, .count = clusters.count[slot]});
        total += clusters.count[slot];
    }
    member_count_ = total;
    if (members_.size() < total)
        members_.resize(total);
}

void Remaking::remake(const Mapped& mapped, const UpdateContext& context)
{
    const ClusterTable& clusters = context.store.clusters;
    end(mapped.slot);
    const auto lives = [&](const Particle& member) { return member.expiry_frame > context.frame; };
    const std::span<const Particle> members = members_of(mapped);
    const std::uint32_t before = grouped();
    const auto count = std::uint32_t(std::count_if(members.begin(), members.end(), lives));
    if (count == 0)
        return;
    add_group(clusters, mapped.slot, count, clusters.slab[mapped.slot.index].capacity - mapped.count);
    std::copy_if(members.begin(), members.end(), particles().begin() + before, lives);
}

void Remaking::add_group(const ClusterTable& clusters, ClusterSlot cluster, std::uint32_t count,
                         std::uint32_t spare_rows)
{
    const std::size_t slot = cluster.index;
    const std::uint32_t first = grouped();
    grouping_.particles.resize(first + count);
    grouping_.pull.resize(first + count, clusters.columns.acceleration ? float(clusters.pull[slot]) : 0);
    measured_.push_back(measured(clusters, slot));
    grouping_.groups.push_back({.pool = {clusters.region[slot], clusters.pool[slot]},
                                .first = first,
                                .count = count,
                                .clusters = 1,
                                .spare_rows = spare_rows});
}

void Remaking::form(SlodTree& tree, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    end_clusters(tree, ending_, context);
    if (grouping_.groups.empty())
        return;
    grouping_.resize(grouped());
    for_each_block(grouped(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            grouping_.place[i] = grouping_.particles[i].position;
    });
    form_groups_in_order(grouping_, context);
    for (std::size_t group = 0; group < grouping_.groups.size(); ++group)
        set_measured(clusters, grouping_.slots[grouping_.groups[group].first_slot].index, measured_[group]);
    link_where_they_are(tree, grouping_, context);
}

} // namespace slod
