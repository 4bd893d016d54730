#include <set>

#include <gtest/gtest.h>

#include "cluster/cluster_table.hpp"

namespace slod {
namespace {

const ClusterTable::Columns everything{
    .map = true, .tide = true, .acceleration = true, .counting_moments = true, .expiry = true};

ClusterSlot take_alive(ClusterTable& clusters)
{
    const ClusterSlot slot = clusters.take_slot();
    clusters.count[slot.index] = 1;
    return slot;
}

TEST(ClusterTable, TakesFreedSlotsBeforeNewOnes)
{
    ClusterTable clusters(everything);
    for (std::uint32_t i = 0; i < 5; ++i)
        EXPECT_EQ(take_alive(clusters), ClusterSlot{i});
    clusters.free_slot({1});
    clusters.free_slot({3});
    EXPECT_EQ(clusters.alive_count(), 3U);
    EXPECT_FALSE(clusters.alive(1));
    EXPECT_EQ(take_alive(clusters), ClusterSlot{3});
    EXPECT_EQ(take_alive(clusters), ClusterSlot{1});
    EXPECT_EQ(take_alive(clusters), ClusterSlot{5});
    EXPECT_EQ(clusters.alive_count(), 6U);
}

TEST(ClusterTable, NoTwoClustersEverHaveTheSameIdOrFormation)
{
    ClusterTable clusters({});
    std::set<ClusterId> ids;
    std::set<std::uint64_t> formations;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const ClusterSlot slot = take_alive(clusters);
        EXPECT_TRUE(ids.insert(clusters.id(slot.index)).second);
        EXPECT_TRUE(formations.insert(clusters.formation[slot.index]).second);
        if (i % 3 != 0)
            clusters.free_slot({i % 7 < clusters.slot_count() && clusters.alive(i % 7) ? i % 7 : slot.index});
    }
    EXPECT_LT(clusters.slot_count(), 300U); // slots were re-used
}

TEST(ClusterTable, HasAllColumnsAskedForAndNoOther)
{
    ClusterTable all(everything), none({});
    take_alive(all);
    take_alive(none);
    EXPECT_EQ(all.map.size() + all.closure.size() + all.tide.size() + all.acceleration.size() +
                  all.variance.size() + all.counting.size() + all.next_expiry.size(),
              7U);
    EXPECT_EQ(none.map.size() + none.closure.size() + none.tide.size() + none.acceleration.size() +
                  none.variance.size() + none.counting.size() + none.next_expiry.size(),
              0U);
    for (const ClusterTable* table : {&all, &none})
        EXPECT_EQ(table->position.size() + table->velocity.size() + table->moments.size() +
                      table->slab.size() + table->offset_max.size() + table->speed_max.size() +
                      table->softening_squared.size() + table->stored.size() + table->count.size() +
                      table->formed_frame.size() + table->formation.size() + table->generation.size() +
                      table->region.size() + table->pool.size() + table->next.size() + table->previous.size(),
                  16U);
}

TEST(ClusterTable, ReservedRoomIsNotMovedWhenTaken)
{
    ClusterTable clusters(everything);
    take_alive(clusters);
    clusters.reserve(1000);
    const Vector3d* position = clusters.position.data();
    const FlowMap* map = clusters.map.data();
    const double* variance = clusters.variance.data();
    for (int i = 0; i < 1000; ++i)
        take_alive(clusters);
    EXPECT_EQ(clusters.position.data(), position);
    EXPECT_EQ(clusters.map.data(), map);
    EXPECT_EQ(clusters.variance.data(), variance);
}

} // namespace
} // namespace slod
