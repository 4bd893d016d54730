#include "cluster/cluster_table.hpp"

#include "core/assert.hpp"

namespace slod {
namespace {

/// Calls visit(column) for every column that the table has.
template <class Visitor>
void for_each_column(ClusterTable& table, const Visitor& visit)
{
    visit(table.position);
    visit(table.velocity);
    visit(table.moments);
    visit(table.offset_max);
    visit(table.speed_max);
    visit(table.softening_squared);
    visit(table.slab);
    visit(table.stored);
    visit(table.count);
    visit(table.formed_frame);
    visit(table.formation);
    visit(table.generation);
    visit(table.region);
    visit(table.pool);
    visit(table.next);
    visit(table.previous);
    if (table.columns.map) {
        visit(table.map);
        visit(table.closure);
    }
    if (table.columns.counting_moments)
        visit(table.counting);
    if (table.columns.expiry)
        visit(table.next_expiry);
    if (table.columns.acceleration) {
        visit(table.acceleration);
        visit(table.pull);
    }
    if (table.columns.variance())
        visit(table.variance);
    if (table.columns.withheld)
        visit(table.withheld);
    if (table.columns.tide)
        visit(table.tide);
    if (table.columns.turning)
        visit(table.turning);
    if (table.columns.strain)
        visit(table.strain);
}

} // namespace

ClusterSlot ClusterTable::take_slot()
{
    if (free_slots.empty()) {
        const auto slot = std::uint32_t(slot_count());
        for_each_column(*this, [](auto& column) { column.emplace_back(); });
        generation.back() = generations;
        free_slots.push_back({slot});
    }
    const ClusterSlot slot = free_slots.back();
    free_slots.pop_back();
    ++generation[slot.index];
    formation[slot.index] = ++formations;
    return slot;
}

void ClusterTable::free_slot(ClusterSlot slot)
{
    SLOD_ASSERT(slot.index < slot_count());
    count[slot.index] = 0;
    free_slots.push_back(slot);
}

void ClusterTable::reserve(std::size_t slots)
{
    const std::size_t needed = alive_count() + slots;
    if (needed <= position.capacity() && needed <= free_slots.capacity())
        return;
    const std::size_t room = needed + needed / 2;
    for_each_column(*this, [room](auto& column) { column.reserve(room); });
    free_slots.reserve(room);
}

} // namespace slod
