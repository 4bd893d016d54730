#include "tree/grouping.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/assert.hpp"
#include "core/make_room.hpp"
#include "core/parallel.hpp"

namespace slod {
namespace {

using Group = Grouping::Group;

std::uint32_t largest_part(const Group& group)
{
    return (group.count + group.clusters - 1) / group.clusters;
}

/// Gives every cluster to be a slot and a slab, in the order of the groups.
void take_slots(Grouping& grouping, ClusterStore& store)
{
    grouping.slots.clear();
    for (Group& group : grouping.groups) {
        group.first_slot = std::uint32_t(grouping.slots.size());
        if (group.clusters == 0)
            continue;
        const std::uint32_t rows = largest_part(group) + group.spare_rows;
        for (std::uint32_t part = 0; part < group.clusters; ++part) {
            const ClusterSlot slot = store.clusters.take_slot();
            store.clusters.slab[slot.index] = store.members.allocate(rows);
            grouping.slots.push_back(slot);
        }
    }
}

/// Of the particles that have one.
double mean_pull(const Grouping& grouping, std::span<const DivisionKey> keys)
{
    double sum = 0, known = 0;
    for (const DivisionKey& key : keys) {
        const double pull = double(grouping.pull[key.index]);
        sum += pull;
        known += pull > 0 ? 1 : 0;
    }
    return known > 0 ? sum / known : 0;
}

/// Forms one of the clusters that the group has been divided into.
void form_part(Grouping& grouping, const Group& group, std::uint32_t part, const UpdateContext& context)
{
    const std::uint32_t begin = part_begin(group.count, group.clusters, part);
    const std::uint32_t end =
        part + 1 == group.clusters ? group.count : part_begin(group.count, group.clusters, part + 1);
    const auto keys = std::span(grouping.keys).subspan(group.first + begin, end - begin);
    const auto ordered = std::span(grouping.ordered).subspan(group.first + begin, end - begin);
    for (std::size_t i = 0; i < keys.size(); ++i)
        ordered[i] = grouping.particles[keys[i].index];
    const ClusterSlot slot = grouping.slots[group.first_slot + part];
    form_cluster(context.store, slot, ordered, context.frame);
    if (context.store.clusters.columns.acceleration)
        context.store.clusters.pull[slot.index] = mean_pull(grouping, keys);
}

void form_group(Grouping& grouping, const Group& group, const UpdateContext& context)
{
    if (group.clusters == 0)
        return;
    const std::span<DivisionKey> keys(grouping.keys.data() + group.first, group.count);
    const Vector3d origin = grouping.place[grouping.order[group.first]];
    for_each_block(group.count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t index = grouping.order[group.first + i];
            const Vector3d x = grouping.place[index] - origin;
            keys[i] = {{float(x.x()), float(x.y()), float(x.z())}, index};
        }
    });
    divide(keys, std::span(grouping.spare_keys).subspan(group.first, group.count), group.clusters);
    const auto form_parts = [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part)
            form_part(grouping, group, std::uint32_t(part), context);
    };
    constexpr std::uint32_t few = 16; // clusters of one task
    if (group.clusters > few)
        for_each_block(group.clusters, few, form_parts);
    else
        form_parts(0, group.clusters);
}

} // namespace

void Grouping::clear()
{
    particles.clear();
    place.clear();
    pull.clear();
    order.clear();
    groups.clear();
}

void Grouping::resize(std::size_t count)
{
    particles.resize(count);
    place.resize(count);
    pull.resize(count);
    order.resize(count);
}

void Grouping::reserve(std::size_t particle_count, std::size_t group_count, std::size_t cluster_count)
{
    make_room(particles, particle_count);
    make_room(place, particle_count);
    make_room(pull, particle_count);
    make_room(order, particle_count);
    make_room(keys, particle_count);
    make_room(spare_keys, particle_count);
    make_room(ordered, particle_count);
    make_room(groups, group_count);
    slots.reserve(cluster_count);
    homes.reserve(cluster_count);
}

void dissolve(SlodTree& tree, Grouping& grouping, std::span<const ClusterSlot> slots,
              const UpdateContext& context)
{
    const ClusterTable& clusters = context.store.clusters;
    std::vector<std::uint32_t>& first =
        grouping.order; // holds the prefix sums until the particles are in place
    first.resize(slots.size());
    std::uint32_t total = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        first[i] = total;
        total += clusters.count[slots[i].index];
    }
    grouping.particles.resize(total);
    grouping.pull.resize(total);
    for_each_block(slots.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t slot = slots[i].index, count = clusters.count[slot];
            map_out(context.store, slots[i], context.frame,
                    std::span(grouping.particles).subspan(first[i], count));
            if (clusters.columns.acceleration)
                std::fill_n(grouping.pull.begin() + first[i], count, float(clusters.pull[slot]));
        }
    });
    end_clusters(tree, slots, context);
    grouping.resize(total);
}

void end_clusters(SlodTree& tree, std::span<const ClusterSlot> slots, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    for (const ClusterSlot slot : slots) {
        unlink(tree.subtrees[clusters.region[slot.index]], clusters, slot);
        context.store.members.retire(clusters.slab[slot.index], context.frame);
        clusters.free_slot(slot);
    }
}

void form_groups(Grouping& grouping, const UpdateContext& context)
{
    grouping.keys.resize(grouping.order.size());
    grouping.spare_keys.resize(grouping.order.size());
    grouping.ordered.resize(grouping.order.size());
    take_slots(grouping, context.store);
    for_each_task(grouping.groups.size(),
                  [&](std::size_t group) { form_group(grouping, grouping.groups[group], context); });
}

void form_groups_in_order(Grouping& grouping, const UpdateContext& context)
{
    grouping.order.resize(grouping.particles.size());
    std::iota(grouping.order.begin(), grouping.order.end(), 0U);
    form_groups(grouping, context);
}

void link_where_they_are(SlodTree& tree, Grouping& grouping, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    grouping.homes.resize(grouping.slots.size());
    for_each_block(grouping.slots.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            grouping.homes[i] = locate(tree, subject_of(clusters, grouping.slots[i].index));
    });
    for (std::size_t i = 0; i < grouping.slots.size(); ++i) {
        const ClusterSlot slot = grouping.slots[i];
        if (!clusters.position[slot.index].allFinite())
            refuse_unbounded(context.frame);
        PoolRef pool = grouping.homes[i];
        if (!pool.valid())
            pool = locate_or_grow(tree, subject_of(clusters, slot.index));
        link(tree.of(pool), clusters, pool.pool, slot);
    }
}

void refuse_unbounded(std::uint64_t frame)
{
    throw std::overflow_error("frame " + std::to_string(frame) +
                              ": particles have left the range of numbers; use a smaller time.step, weaker "
                              "forces, or a larger softening of the kinds");
}

void link_groups(SlodTree& tree, const Grouping& grouping, ClusterTable& clusters)
{
    for (const Group& group : grouping.groups)
        for (std::uint32_t part = 0; part < group.clusters; ++part)
            link(tree.of(group.pool), clusters, group.pool.pool, grouping.slots[group.first_slot + part]);
}

} // namespace slod
