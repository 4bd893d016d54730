#include <gtest/gtest.h>

#include "cluster/sums_problems.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

/// Three clusters with aged maps, far from the origin.
class SumsProblems : public testing::Test {
protected:
    SumsProblems()
    {
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            ParticleSet particles = test::ball(40, 2, 1, seed, {800, 4, double(seed)});
            test::give_masses(particles, 0.1, 3, seed);
            const ClusterSlot slot = test::form(store, particles);
            store.clusters.map[slot.index] = test::aged_map(store.rule, 16, 1, seed);
        }
    }

    ClusterStore store = test::empty_store({MapKind::Full, 0.3, 0.05});
};

TEST_F(SumsProblems, AreNoneInSoundClusters)
{
    EXPECT_EQ(sums_problems(store, 16), Problems{});
}

TEST_F(SumsProblems, AreFoundInAWrongMass)
{
    store.clusters.moments[1].weight *= 1 + 1e-10;
    EXPECT_FALSE(sums_problems(store, 16).empty());
}

TEST_F(SumsProblems, SayByWhatShareHoweverSmall)
{
    store.clusters.moments[1].weight *= 1 + 1e-10;
    const Problems found = sums_problems(store, 16);
    ASSERT_FALSE(found.empty());
    EXPECT_NE(found[0].find("e-1"), std::string::npos) << found[0];
}

// What the moments say moves the members, and so their mean, away from the centre.
TEST_F(SumsProblems, AreFoundInAMomentThatIsNotTheMembers)
{
    store.clusters.moments[1].o.x() += 1e-8;
    EXPECT_FALSE(sums_problems(store, 16).empty());
}

TEST_F(SumsProblems, AreFoundInASecondMomentThatIsNotTheMembers)
{
    store.clusters.moments[2].oo.xy += 1e-6;
    EXPECT_EQ(sums_problems(store, 16).size(), 1U);
}

} // namespace
} // namespace slod
