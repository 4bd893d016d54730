#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "tree/expire.hpp"

namespace slod {
namespace {

/// 40 clusters of 10 in a ball of several cells; particle k dies at the end of frame k mod 20 + 1.
class ExpiryTest : public testing::Test {
protected:
    ExpiryTest()
    {
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            ParticleSet particles = test::ball(10, 1, 0, seed, {double(seed % 7), double(seed % 5), 0});
            for (Particle& particle : particles) {
                particle.id += 10 * seed;
                particle.expiry_frame = std::uint32_t(particle.id % 20 + 1);
            }
            world.add(particles);
        }
    }

    test::World world{{MapKind::Identity, 0, 1}, {.masses = true, .kinds = false, .expiry = true}, {}, 2};
    Expiry expiry;
};

TEST_F(ExpiryTest, EndsEveryLifeAtTheEndOfItsFrame)
{
    for (std::uint64_t frame = 0; frame <= 20; ++frame) {
        EXPECT_EQ(expiry.update(world.tree, world.context(frame)), frame == 0 ? 0U : 20U);
        const ParticleSet left = test::members(world.store, frame);
        EXPECT_EQ(left.size(), 400 - 20 * frame);
        for (const Particle& particle : left)
            EXPECT_GT(particle.expiry_frame, frame);
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{}) << "frame " << frame;
    }
}

TEST_F(ExpiryTest, FreesClustersThatAreLeftEmptyAndTheirSlabs)
{
    const Slab slab = world.store.clusters.slab[0];
    expiry.update(world.tree, world.context(100));
    EXPECT_EQ(world.store.clusters.alive_count(), 0U);
    for (const Pool& pool : world.region().pools)
        EXPECT_EQ(pool.members + pool.clusters, 0U);
    world.store.members.recycle(101);
    bool reused = false;
    for (int i = 0; i < 40; ++i)
        reused = reused || world.store.members.allocate(10).first == slab.first;
    EXPECT_TRUE(reused);
}

TEST_F(ExpiryTest, MakesUpForFramesThatWereLeftOut)
{
    EXPECT_EQ(expiry.update(world.tree, world.context(7)), 140U);
    EXPECT_EQ(expiry.update(world.tree, world.context(19)), 240U);
    EXPECT_EQ(expiry.update(world.tree, world.context(19)), 0U);
}

} // namespace
} // namespace slod
