#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/state_hash.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

/// A world that has every column, two cells, a divided one, and a free slot; the slabs begin after `unused`
/// rows.
class Hashed {
public:
    explicit Hashed(std::uint32_t unused = 0)
        : world({MapKind::Full, 0.1, 0.5}, {.masses = true, .kinds = true, .expiry = true, .withheld = true},
                {.max_cluster_size = 16}, 4)
    {
        if (unused > 0)
            world.store.members.allocate(unused);
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            ParticleSet particles = test::ball(6, 1, 1, seed, {2.0 + double(seed % 2) * 4, 2, 2});
            for (Particle& particle : particles) {
                particle.id += 10 * seed;
                particle.kind = std::uint8_t(particle.id % 3);
                particle.expiry_frame = std::uint32_t(100 + particle.id);
            }
            const ClusterSlot slot = world.add(particles, 3, 4);
            world.store.clusters.map[slot.index] = test::aged_map(world.store.rule, 5, 1, seed);
        }
        const PoolId pool = locate(world.region(), Vector3d(2, 2, 2));
        expand(world.region(), world.store.clusters, pool, 0, 2.0);
        world.region().pools[pool.index].turn_frame = 3;
        world.region().pools[pool.index].due_frame = 7;
        free_slot = test::form(world.store, test::ball(2, 1, 1, 9)).index;
        world.store.clusters.free_slot({free_slot});
        // Room without a member, which the hash must not see.
        world.store.members.ids(world.store.clusters.slab[0])[9] = unused;
    }

    std::uint64_t hash() const { return hash_state(world.store, world.tree, {frame, counters, cohorts}); }

    test::World world;
    std::uint64_t frame = 8;
    std::vector<std::uint64_t> counters = {4, 5};
    std::vector<ClusterId> cohorts = {{{2}, 1}, {}};
    std::uint32_t free_slot = 0;
};

/// One value of the state, as bytes, by name.
struct Value {
    std::string name;
    void* bytes;
    std::size_t size;
};

template <class T>
Value value(const std::string& name, T& of)
{
    return {name, &of, sizeof of};
}

/// A value of each column, of clusters, members, pools, settings and counters, whose bits are free.
std::vector<Value> plain_values(Hashed& state)
{
    ClusterStore& store = state.world.store;
    ClusterTable& clusters = store.clusters;
    Subtree& region = state.world.region();
    Pool& pool = region.pools[0];
    const Slab& slab = clusters.slab[2];
    return {value("position", clusters.position[2]),
            value("velocity", clusters.velocity[2]),
            value("map", clusters.map[2]),
            value("moments", clusters.moments[2]),
            value("counting", clusters.counting[2]),
            value("offset_max", clusters.offset_max[2]),
            value("speed_max", clusters.speed_max[2]),
            value("softening_squared", clusters.softening_squared[2]),
            value("next_expiry", clusters.next_expiry[2]),
            value("withheld", clusters.withheld[2]),
            value("pull", clusters.pull[2]),
            value("formed_frame", clusters.formed_frame[2]),
            value("formation", clusters.formation[2]),
            value("generation", clusters.generation[2]),
            value("region of cluster", clusters.region[2]),
            value("pool of cluster", clusters.pool[2]),
            value("next", clusters.next[2]),
            value("previous", clusters.previous[2]),
            value("offset", store.members.offsets(slab)[5]),
            value("id", store.members.ids(slab)[5]),
            value("mass", store.members.masses(slab)[5]),
            value("kind", store.members.kinds(slab)[5]),
            value("expiry", store.members.expiries(slab)[5]),
            value("first", pool.first),
            value("clusters", pool.clusters),
            value("members", pool.members),
            value("phase", pool.phase),
            value("turn_frame", pool.turn_frame),
            value("due_frame", pool.due_frame),
            value("box", region.nodes[pool.node.index].box),
            value("cell_side", region.cell_side),
            value("region", region.region),
            value("max_cluster_size", region.settings.max_cluster_size),
            value("max_breadth", region.settings.max_breadth),
            value("pool_factor", region.settings.pool_factor),
            value("speed_ratio", region.settings.speed_ratio),
            value("angle_deg", region.settings.angle_deg),
            value("speed_floor", region.settings.speed_floor),
            value("uniform_mass", store.uniform_mass),
            value("frame", state.frame),
            value("counter", state.counters[1]),
            value("cohort", state.cohorts[0])};
}

/// Those that say where or how many: another bit than the lowest would lead out of the arrays.
std::vector<Value> places(Hashed& state)
{
    ClusterTable& clusters = state.world.store.clusters;
    return {value("stored", clusters.stored[2]), value("count", clusters.count[2]),
            value("node of pool", state.world.region().pools[0].node)};
}

void flip(const Value& value, std::size_t bit)
{
    auto* byte = static_cast<unsigned char*>(value.bytes) + bit / 8;
    *byte = static_cast<unsigned char>(*byte ^ (1U << (bit % 8)));
}

TEST(StateHash, ChangesWithEveryBitOfTheState)
{
    Hashed state;
    const std::uint64_t before = state.hash();
    const auto expect_seen = [&](const Value& value, std::size_t bit) {
        flip(value, bit);
        EXPECT_NE(state.hash(), before) << value.name << ", bit " << bit;
        flip(value, bit);
    };
    for (const Value& value : plain_values(state))
        for (std::size_t bit = 0; bit < 8 * value.size; ++bit)
            expect_seen(value, bit);
    for (const Value& value : places(state))
        expect_seen(value, 0);
    expect_seen(value("merging", state.world.tree.merging), 0);
    EXPECT_EQ(state.hash(), before);
}

TEST(StateHash, DoesNotDependOnWhereTheSlabsAre)
{
    EXPECT_EQ(Hashed(0).hash(), Hashed(1000).hash());
}

TEST(StateHash, DoesNotSeeFreeSlotsOrUnusedRows)
{
    Hashed state;
    const std::uint64_t before = state.hash();
    ClusterTable& clusters = state.world.store.clusters;
    clusters.position[state.free_slot] = {1, 2, 3};
    clusters.generation[state.free_slot] += 5;
    state.world.store.members.ids(clusters.slab[2])[6] = 12345; // it has 6 members
    EXPECT_EQ(state.hash(), before);
}

TEST(StateHash, DoesNotSeeWhatEveryFrameDerivesAnew)
{
    Hashed state;
    const std::uint64_t before = state.hash();
    ClusterTable& clusters = state.world.store.clusters;
    clusters.acceleration[2] = {1, 2, 3};
    clusters.tide[2].xy = 4;
    clusters.closure[2] = 5;
    clusters.variance[2] = 6;
    EXPECT_EQ(state.hash(), before);
}

TEST(StateHash, SeesAClusterMoreOrLessAndOneInAnotherSlot)
{
    Hashed state;
    const std::uint64_t before = state.hash();
    state.world.store.clusters.count[3] = 0;
    EXPECT_NE(state.hash(), before);
    state.world.store.clusters.count[3] = 6;
    test::form(state.world.store, test::ball(2, 1, 1, 9));
    EXPECT_NE(state.hash(), before);

    // Alike but for the slot.
    test::World first({MapKind::Identity, 0, 1}, {}, {}, 4), second({MapKind::Identity, 0, 1}, {}, {}, 4);
    const ParticleSet particles = test::ball(6, 1, 1, 1);
    test::form(first.store, particles);
    const ClusterSlot left = test::form(second.store, particles), other = test::form(second.store, particles);
    second.store.clusters.free_slot(left);
    second.store.clusters.formation[other.index] = first.store.clusters.formation[0];
    second.store.clusters.generation[other.index] = first.store.clusters.generation[0];
    EXPECT_NE(hash_state(first.store, first.tree, {}), hash_state(second.store, second.tree, {}));
}

} // namespace
} // namespace slod
