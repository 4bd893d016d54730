#include <cmath>
#include <limits>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/merging_pairs.hpp"
#include "support/random_draws.hpp"
#include "tree/merge_rules.hpp"
#include "tree/regrouping.hpp"

namespace slod {
namespace {

constexpr double step = 0.05;
const MapRule rigid{MapKind::Identity, 0, step};

void drift(test::World& world)
{
    ClusterTable& clusters = world.store.clusters;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
        if (clusters.alive(slot))
            clusters.position[slot] += step * clusters.velocity[slot];
}

/// Diameter of the ball with the largest principal variance of these places.
double breadth_of(const ParticleSet& particles)
{
    Vector3d mean{0, 0, 0};
    for (const Particle& particle : particles)
        mean += particle.position / double(particles.size());
    Matrix3d squares = Matrix3d::Zero();
    for (const Particle& particle : particles)
        squares += (particle.position - mean) * (particle.position - mean).transpose();
    return breadth(Symmetric3::of(squares), double(particles.size()));
}

ParticleSet some(std::size_t count, double radius, const Vector3d& centre, std::uint64_t first_id)
{
    ParticleSet particles = test::ball(count, radius, 0, first_id, centre);
    for (Particle& particle : particles)
        particle.id += first_id;
    return particles;
}

TEST(Regrouping, AClusterThatCrossesMovesToThePoolWhereItIs)
{
    test::World world(rigid, {}, {}, 1);
    const ClusterSlot slot =
        world.add({{.position = {0.93, 0.5, 0.5}, .velocity = {1, 0.33, -4}, .id = 1, .mass = 1}});
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    std::set<std::uint32_t> pools;
    for (std::uint64_t frame = 1; frame <= 100; ++frame) {
        drift(world);
        regrouping.update(world.tree, frame, counts);
        const Vector3d& x = world.store.clusters.position[slot.index];
        ASSERT_EQ(world.store.clusters.pool[slot.index], locate(world.region(), x)) << "frame " << frame;
        ASSERT_EQ(problems(world.tree, world.store.clusters), Problems{}) << "frame " << frame;
    }
    // In 5 units of time it crosses 5, 2 and 20 faces.
    EXPECT_EQ(counts.crossings, 27U);
    EXPECT_LE(world.region().pools.size(), 12U); // cells that were left are pruned and re-used
}

TEST(Regrouping, AClusterBeyondTheRimOfTheGridStaysWhereItIs)
{
    test::World world(rigid, {}, {}, 1);
    world.add({{.position = {1e12, 0, 0}, .velocity = {1e9, 0, 0}, .id = 1, .mass = 1}});
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 20; ++frame) {
        drift(world);
        regrouping.update(world.tree, frame, counts);
    }
    EXPECT_EQ(counts.crossings, 0U);
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

TEST(Regrouping, AClusterThatHasGrownTooLargeIsSplitWithinEightFramesIntoPartsThatAreNot)
{
    for (const std::size_t size : {11U, 20U, 21U, 95U}) {
        test::World world(rigid, {}, {.max_cluster_size = 10}, 8);
        world.add(some(size, 1, {2, 2, 2}, 1));
        const ParticleSet before = test::members(world.store, 1);
        Regrouping regrouping({}, world.context(0));
        UpdateCounts counts;
        for (std::uint64_t frame = 1; frame <= 8; ++frame)
            regrouping.update(world.tree, frame, counts);
        EXPECT_EQ(counts.splits, 1U);
        EXPECT_EQ(counts.reformed_members, size);
        EXPECT_EQ(world.store.clusters.alive_count(), (size + 9) / 10);
        for (const std::uint32_t count : world.store.clusters.count)
            EXPECT_LE(count, 10U);
        const ParticleSet after = test::members(world.store, 1);
        ASSERT_EQ(after.size(), size);
        for (std::size_t i = 0; i < size; ++i)
            EXPECT_LE((after[i].position - before[i].position).norm(), 4 * 0x1p-24); // two roundings of 2
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
}

TEST(Regrouping, AClusterThatIsTooWideIsSplitUntilNoPartIs)
{
    for (const double mass : {0.0, 1.0, 1e-5, 3e7}) { // breadth counts particles
        test::World world(rigid, {.masses = mass != 1}, {.max_cluster_size = 1000, .max_breadth = 0.5}, 0.5);
        ParticleSet particles = some(200, 1, {2, 2, 2}, 1);
        for (Particle& particle : particles)
            particle.mass = float(mass);
        world.add(particles);
        Regrouping regrouping({}, world.context(0));
        UpdateCounts counts;
        for (std::uint64_t frame = 1; frame <= 10; ++frame)
            regrouping.update(world.tree, frame, counts);
        for (std::uint32_t slot = 0; slot < world.store.clusters.slot_count(); ++slot)
            if (world.store.clusters.alive(slot)) {
                EXPECT_LE(breadth_of(test::members(world.store, ClusterSlot{slot}, 10)), 0.5 * (1 + 1e-6));
            }
        EXPECT_GT(world.store.clusters.alive_count(), 8U);
        EXPECT_LT(world.store.clusters.alive_count(), 200U);
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
}

TEST(Regrouping, CoincidentParticlesAreSplitByTheirNumber)
{
    test::World world(rigid, {}, {.max_cluster_size = 10, .max_breadth = 1}, 1);
    world.add(some(500, 0, {0.5, 0.5, 0.5}, 1));
    world.tree.merging = true;
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 40; ++frame)
        regrouping.update(world.tree, frame, counts);
    EXPECT_EQ(world.store.clusters.alive_count(), 50U);
    EXPECT_EQ(test::members(world.store, 40).size(), 500U);
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

TEST(Regrouping, PoolsAreDividedWhereItIsCrowdedAndMergedWhereItIsNot)
{
    test::World world(rigid, {}, {.max_cluster_size = 4, .pool_factor = 4}, 8);
    for (const Particle& particle : test::ball(1000, 3, 0, 1, {4, 4, 4}))
        world.add({particle});
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    regrouping.update(world.tree, 8, counts);
    for (const Pool& pool : world.region().pools)
        if (pool.node.valid()) {
            EXPECT_LE(pool.members, 1.4 * 16);
        }
    EXPECT_GT(world.region().pool_count(), 1000U / 23);
    // All but a few end.
    for (std::uint32_t slot = 10; slot < 1000; ++slot) {
        unlink(world.region(), world.store.clusters, {slot});
        world.store.clusters.free_slot({slot});
    }
    for (std::uint64_t frame = 9; frame <= 800; ++frame)
        regrouping.update(world.tree, frame, counts);
    EXPECT_EQ(world.region().pool_count(), 1U);
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

TEST(MayMerge, AsksForSizeBreadthSpeedRatioAndAngle)
{
    const RegionSettings limits{
        .max_cluster_size = 10, .max_breadth = 4, .speed_ratio = 2, .angle_deg = 30, .speed_floor = 0.5};
    struct Pair {
        const char* claim;
        std::size_t size; // of the second one; the first has 5
        double distance;
        Vector3d velocity; // of the second one; the first has (1, 0, 0)
        bool may;
    };
    const double cos30 = std::cos(29.9 * 0.017453292519943295), sin30 = std::sin(29.9 * 0.017453292519943295);
    for (const Pair& pair :
         {Pair{"near and alike", 5, 1, {1, 0, 0}, true}, Pair{"together too many", 6, 1, {1, 0, 0}, false},
          Pair{"together too wide", 5, 4, {1, 0, 0}, false},
          Pair{"just as fast as allowed", 5, 1, {1.99, 0, 0}, true},
          Pair{"too fast", 5, 1, {2.01, 0, 0}, false},
          Pair{"just as slow as allowed", 5, 1, {0.501, 0, 0}, true},
          Pair{"too slow", 5, 1, {0.499, 0, 0}, false},
          Pair{"within the angle", 5, 1, {cos30, sin30, 0}, true},
          Pair{"beyond the angle", 5, 1, {0.86, 0.51, 0}, false}, Pair{"opposite", 5, 1, {-1, 0, 0}, false},
          Pair{"at rest", 5, 1, {0, 0, 0}, false}}) {
        test::World world(rigid, {}, limits, 4);
        ParticleSet first = some(5, 0.5, {0, 0, 0}, 1);
        ParticleSet second = some(pair.size, 0.5, {pair.distance, 0, 0}, 100);
        for (Particle& particle : first)
            particle.velocity = {1, 0, 0};
        for (Particle& particle : second)
            particle.velocity = pair.velocity;
        const ClusterSlot a = world.add(first);
        const ClusterSlot b = world.add(second);
        EXPECT_EQ(test::may_merge(world.store, limits, a, b), pair.may) << pair.claim;
        EXPECT_EQ(test::may_merge(world.store, limits, b, a), pair.may)
            << pair.claim << ", the other way round";
        for (const ClusterSlot slot : {a, b})
            world.store.clusters.velocity[slot.index] *= 0.2; // now slower than the floor
        const bool slow = std::max(1.0, pair.velocity.norm()) * 0.2 <= 0.5;
        const bool fits = pair.size <= 5 && pair.distance < 4;
        EXPECT_EQ(test::may_merge(world.store, limits, a, b), slow && fits)
            << pair.claim << ", below the floor";
    }
}

TEST(MayMerge, TakesParallelVelocitiesAsSuchWhateverTheirRounding)
{
    const RegionSettings limits{.speed_ratio = 10, .angle_deg = 0};
    Random random(13, 0, 0);
    for (int i = 0; i < 1000; ++i) {
        test::World world(rigid, {}, limits, 4);
        ParticleSet first = some(1, 0, {0, 0, 0}, 1), second = some(1, 0, {0, 0, 0}, 2);
        first[0].velocity = random_direction(random);
        second[0].velocity = (1 + 3 * random.uniform()) * first[0].velocity;
        const ClusterSlot a = world.add(first), b = world.add(second);
        ASSERT_TRUE(test::may_merge(world.store, limits, a, b)) << first[0].velocity.transpose();
        const Vector3d across = first[0].velocity.cross(Vector3d(random_direction(random))).normalized();
        world.store.clusters.velocity[b.index] += 1e-6 * across;
        ASSERT_FALSE(test::may_merge(world.store, limits, a, b)) << "a millionth off";
    }
}

// What two clusters together measure is what their particles measure, whatever these weigh.
TEST(MayMerge, MeasuresTheUnionByItsParticlesPlaces)
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        for (const double heaviest : {0.0, 1.0, 1e6}) {
            test::World world(rigid, {}, {}, 4);
            ParticleSet first = some(6, 1, {0, 0, 0}, 1 + seed);
            ParticleSet second = some(9, 0.5, {1.5, 0.3, 0}, 1000 + seed);
            test::give_masses(first, 0, heaviest, seed);
            test::give_masses(second, 0, heaviest, seed);
            ParticleSet both = first;
            both.insert(both.end(), second.begin(), second.end());
            const double measured = breadth_of(both);
            const ClusterSlot a = world.add(first);
            const ClusterSlot b = world.add(second);
            // Offsets are rounded to float: 1e-6 is well beyond that.
            EXPECT_TRUE(test::may_merge(world.store, {.max_breadth = measured * (1 + 1e-6)}, a, b));
            EXPECT_FALSE(test::may_merge(world.store, {.max_breadth = measured * (1 - 1e-6)}, a, b));
        }
    }
}

TEST(MayMerge, MeasuresTheUnionAlikeWhateverTheCommonMass)
{
    for (const float mass : {1e-6F, 1.0F, 1e6F}) {
        test::World world(rigid, {.masses = false}, {}, 4);
        world.store.uniform_mass = mass;
        ParticleSet first = some(6, 1, {0, 0, 0}, 1);
        ParticleSet second = some(9, 0.5, {1.5, 0.3, 0}, 1000);
        for (ParticleSet* particles : {&first, &second})
            for (Particle& particle : *particles)
                particle.mass = mass;
        ParticleSet both = first;
        both.insert(both.end(), second.begin(), second.end());
        const double measured = breadth_of(both);
        const ClusterSlot a = world.add(first);
        const ClusterSlot b = world.add(second);
        EXPECT_TRUE(test::may_merge(world.store, {.max_breadth = measured * (1 + 1e-6)}, a, b)) << mass;
        EXPECT_FALSE(test::may_merge(world.store, {.max_breadth = measured * (1 - 1e-6)}, a, b)) << mass;
    }
}

TEST(WiderThan, IsWhetherTheBreadthExceedsTheLimit)
{
    Random random(1, 0, 0);
    for (int i = 0; i < 2000; ++i) {
        Matrix3d root;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                root(row, column) =
                    random_normal(random) * (i % 3 == 0 && row == 2 ? 1e-9 : 1); // some flat as paper
        const Symmetric3 sum = Symmetric3::of(7 * root * root.transpose());
        const double exact = breadth(sum, 7);
        EXPECT_TRUE(wider_than(exact * (1 - 1e-9), sum, 7));
        EXPECT_FALSE(wider_than(exact * (1 + 1e-9), sum, 7));
        const double limit = 4 * random.uniform() * exact;
        EXPECT_EQ(wider_than(limit, sum, 7), exact > limit);
    }
    EXPECT_FALSE(wider_than(1, {}, 5));
    EXPECT_FALSE(wider_than(0.5, {}, 0));
}

// A median is found in n + n/2 + n/4 + ... looks. Each level of leaves has halves of the one above, which
// come out alike up to the roots of their counts: two levels more than if to the last particle.
TEST(Regrouping, ACrowdedPoolIsSplitWithALogarithmOfLooksAtEachCluster)
{
    for (const std::size_t count : {1000U, 10'000U, 100'000U}) {
        test::World world(rigid, {}, {.max_cluster_size = 1}, 16);
        for (const Particle& particle : test::cube(count, 8, 1, {8, 8, 8}))
            world.add({particle});
        Regrouping regrouping({}, world.context(0));
        UpdateCounts counts;
        regrouping.update(world.tree, 1, counts);
        const double levels = std::log2(double(count) / 22) + 2;
        EXPECT_LE(counts.split_keys, 2 * double(count) * levels) << count;
        EXPECT_GT(world.region().pool_count(), count / 23);
        for (const Pool& pool : world.region().pools)
            ASSERT_LE(pool.members, 22U);
        ASSERT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
}

// One cluster of sixty-one particles and forty of one: half of the particles are in the first.
TEST(Regrouping, ACrowdedPoolIsSplitAtTheMedianOfItsMembers)
{
    test::World world(rigid, {}, {.max_cluster_size = 64, .pool_factor = 1}, 16);
    for (int i = 0; i < 40; ++i)
        world.add({{.position = {8 + 0.1 * i, 8, 8},
                    .velocity = {0, 0, 0},
                    .id = std::uint64_t(i) + 1,
                    .mass = 1}});
    world.add(some(61, 0.01, {4, 8, 8}, 100));
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 8; ++frame)
        regrouping.update(world.tree, frame, counts);
    const Subtree& tree = world.region();
    ASSERT_EQ(tree.pool_count(), 2U);
    std::vector<std::uint32_t> members;
    for (const Pool& pool : tree.pools)
        members.push_back(pool.members);
    std::sort(members.begin(), members.end());
    EXPECT_EQ(members, (std::vector<std::uint32_t>{40, 61}));
}

// What a slot held before is no velocity of the surroundings.
TEST(Regrouping, ClustersMergeWhateverEndedOnesLeftBehind)
{
    test::World world(rigid, {}, {.max_cluster_size = 8}, 16);
    world.tree.merging = true;
    const ClusterSlot ended = world.add({{.position = {4, 4, 4}, .velocity = {1, 0, 0}, .id = 1, .mass = 1}});
    for (std::uint64_t id = 2; id <= 3; ++id)
        world.add({{.position = {4, 4, 4}, .velocity = {1, 0, 0}, .id = id, .mass = 1}});
    unlink(world.region(), world.store.clusters, ended);
    world.store.clusters.free_slot(ended);
    world.store.clusters.velocity[ended.index].setConstant(std::numeric_limits<double>::infinity());
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 16; ++frame)
        regrouping.update(world.tree, frame, counts);
    EXPECT_EQ(counts.merges, 1U);
}

} // namespace
} // namespace slod
