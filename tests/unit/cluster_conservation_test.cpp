#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "cluster/conserved.hpp"
#include "cluster/sums_problems.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/totals.hpp"
#include "tree/grouping.hpp"

namespace slod {
namespace {

constexpr std::uint64_t age = 16;

/// Five clusters of 40 that move at 3 about a place 10 from the origin, with aged maps of each kind.
class ConservationByMap : public testing::TestWithParam<MapKind> {
protected:
    ConservationByMap()
    {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            ParticleSet particles = test::ball(40, 2, 1, seed, {8, 4, double(seed)});
            test::give_masses(particles, 0.1, 3, seed);
            for (Particle& particle : particles) {
                particle.id += 100 * seed;
                particle.velocity += Vector3d(1, 2, -2);
            }
            slots.push_back(world.add(particles, 0, 1));
            if (rule.kind == MapKind::Full)
                world.store.clusters.map[slots.back().index] = test::aged_map(rule, age, 1, seed);
        }
        before = test::members(world.store, age);
    }

    MapRule rule{GetParam(), GetParam() == MapKind::Identity ? 0 : 0.3, 0.05};
    test::World world{rule, {}, {}, 8};
    std::vector<ClusterSlot> slots;
    ParticleSet before;

    /// Ends `ended` and forms `count` clusters of their members.
    void regroup(std::span<const ClusterSlot> ended, std::uint32_t count)
    {
        Grouping grouping;
        dissolve(world.tree, grouping, ended, world.context(age));
        std::iota(grouping.order.begin(), grouping.order.end(), 0U);
        for (std::size_t i = 0; i < grouping.particles.size(); ++i)
            grouping.place[i] = grouping.particles[i].position;
        const PoolRef pool = locate_or_grow(world.tree, grouping.place.front());
        grouping.groups.push_back(
            {.pool = pool, .count = std::uint32_t(grouping.particles.size()), .clusters = count});
        form_groups(grouping, world.context(age));
        link_groups(world.tree, grouping, world.store.clusters);
        EXPECT_EQ(grouping.slots.size(), count);
    }

    /// Mass and momentum to 1e-12; kinetic energy and angular momentum to 1e-7 of their internal parts:
    /// each member's offset and velocity are rounded to float once, by 6e-8 at most, with either sign.
    void expect_conserved(const ParticleSet& expected)
    {
        const ConservedQuantities then = test::totals(expected);
        const ConservedQuantities now = conserved_quantities(world.store, age);
        const test::InternalMotion internal = test::internal_motion(expected);
        EXPECT_NEAR(now.mass, then.mass, 1e-12 * then.mass);
        EXPECT_LE((now.momentum - then.momentum).norm(), 1e-12 * then.momentum.norm());
        EXPECT_NEAR(now.kinetic_energy, then.kinetic_energy, 1e-7 * internal.kinetic_energy);
        EXPECT_LE((now.angular_momentum - then.angular_momentum).norm(), 1e-7 * internal.angular_momentum);
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
};

INSTANTIATE_TEST_SUITE_P(Maps, ConservationByMap,
                         testing::Values(MapKind::Identity, MapKind::Scalar, MapKind::Full),
                         [](const auto& kind) {
                             return std::string(names(kind.param)[std::size_t(kind.param)]);
                         });

TEST_P(ConservationByMap, MergersConserve)
{
    regroup(std::span(slots).first(2), 1);
    EXPECT_EQ(world.store.clusters.alive_count(), 4U);
    expect_conserved(before);
}

TEST_P(ConservationByMap, SplitsConserve)
{
    regroup(std::span(slots).first(1), 7);
    EXPECT_EQ(world.store.clusters.alive_count(), 11U);
    expect_conserved(before);
}

TEST_P(ConservationByMap, ReformationConserves)
{
    regroup(slots, 9);
    EXPECT_EQ(world.store.clusters.alive_count(), 9U);
    expect_conserved(before);
}

// Those that stay are where the map had them, up to what the sums over them round in double: no offset is
// stored anew. Their bounds and sums are their own.
TEST_P(ConservationByMap, MembersThatAreReleasedTakeWhatIsTheirs)
{
    ClusterTable& clusters = world.store.clusters;
    const ClusterSlot slot = slots.front();
    const ParticleSet all = test::members(world.store, slot, age);
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < clusters.stored[slot.index]; row += 3)
        rows.push_back(row);
    const Slab old = clusters.slab[slot.index];
    std::vector<std::uint64_t> released;
    for (const std::uint32_t row : rows)
        released.push_back(world.store.members.ids(old)[row]);
    const auto left = std::uint32_t(all.size() - rows.size());
    release_members(world.store, slot, world.store.members.allocate(left), rows, age);
    world.region().pools[clusters.pool[slot.index].index].members -= std::uint32_t(rows.size());

    std::erase_if(before, [&](const Particle& particle) {
        return std::find(released.begin(), released.end(), particle.id) != released.end();
    });
    expect_conserved(before);
    EXPECT_EQ(sums_problems(world.store, age), Problems{});
    const ParticleSet kept = test::members(world.store, slot, age);
    ASSERT_EQ(kept.size(), left);
    for (const Particle& particle : kept) {
        const auto was = std::find_if(all.begin(), all.end(),
                                      [&](const Particle& each) { return each.id == particle.id; });
        ASSERT_NE(was, all.end());
        EXPECT_LE((particle.position - was->position).norm(), 1e-13 * was->position.norm());
        EXPECT_LE((particle.velocity - was->velocity).norm(), 1e-13 * was->velocity.norm());
    }
}

TEST_P(ConservationByMap, BirthsAddWhatIsBorn)
{
    for (std::size_t i = 0; i < slots.size(); ++i) {
        Particle born = test::ball(1, 2, 3, 50 + i, {8, 4, double(i + 1)}).front();
        born.id = 1000 + i;
        born.mass = 7;
        insert_member(world.store, slots[i], born, age);
        world.region().pools[world.store.clusters.pool[slots[i].index].index].members += 1;
        before.push_back(born);
    }
    expect_conserved(before);
}

} // namespace
} // namespace slod
