#include <gtest/gtest.h>

#include "support/attracting_world.hpp"
#include "support/clouds.hpp"

// Regions of interest as sources: a light one may be ignored by the others.
namespace slod::test {
namespace {

constexpr std::size_t heavy_count = 700, light_count = 400;

/// A cloud, and a lighter one beside and within it, larger than it.
ParticleSet heavy()
{
    return plummer_sphere(heavy_count, 1);
}

ParticleSet light()
{
    return cloud(light_count, 2, [](Random& random) { return Vector3d(point_in_ball(random, 3)); });
}

class GravityRegions : public testing::TestWithParam<bool> {
protected:
    AttractingWorld evaluated(const std::vector<ParticleSet>& regions, Attracts second = Attracts::Everything)
    {
        AttractingWorld world(regions);
        world.settings.direct_below = GetParam() ? 0 : 1'000'000;
        if (world.view.regions.size() > 1) // a region that holds nothing is not in the view
            world.view.regions[1].attracts = second;
        world.evaluate();
        counts = world.evaluate(); // by the pulls of the first
        return world;
    }

    ForceCounts counts; ///< of the last world
};

TEST_P(GravityRegions, AreRunsOfBodiesAndOfNodes)
{
    const AttractingWorld world = evaluated({heavy(), light()});
    const ForceView& view = world.view;
    ASSERT_EQ(view.regions.size(), 2U);
    EXPECT_EQ(view.regions[0].first_body + view.regions[0].first_node, 0U);
    EXPECT_EQ(view.regions[0].body_count(), heavy_count);
    EXPECT_EQ(view.regions[0].last_body, view.regions[1].first_body);
    EXPECT_EQ(view.regions[0].last_node, view.regions[1].first_node);
    EXPECT_EQ(view.regions[1].last_body, view.body_count());
    EXPECT_EQ(view.regions[1].last_node, view.nodes.size());
    EXPECT_EQ(view.nodes[view.regions[1].first_node].first, heavy_count);
}

// Units are powers of two, so that those of another extent and mass change no bit either.
TEST_P(GravityRegions, HeavyOnesDoNotFeelALightOneByOneBit)
{
    const AttractingWorld alone = evaluated({heavy(), {}});
    for (const Attracts attracts : {Attracts::OwnRegion, Attracts::Nothing}) {
        const AttractingWorld world = evaluated({heavy(), light()}, attracts);
        for (std::size_t body = 0; body < heavy_count; ++body)
            ASSERT_EQ(world.acceleration(body), alone.acceleration(body)) << body;
    }
}

TEST_P(GravityRegions, NoPairOfALightSourceAndAHeavyTargetIsSummed)
{
    evaluated({heavy(), {}});
    const std::uint64_t among_heavy = counts.interactions;
    const AttractingWorld world = evaluated({heavy(), light()}, Attracts::Nothing);
    std::uint64_t onto_heavy = 0;
    for (std::size_t run = 0; run < world.lists.runs.size(); ++run)
        if (world.lists.runs[run].region == 0)
            onto_heavy += world.lists.counts[run].interactions;
    EXPECT_EQ(onto_heavy, among_heavy);
    EXPECT_GT(counts.interactions, among_heavy);
}

TEST_P(GravityRegions, LightBodiesFeelTheHeavyOnesAllTheSame)
{
    const AttractingWorld world = evaluated({heavy(), light()}, Attracts::Nothing);
    for (std::size_t body = heavy_count; body < world.bodies.size(); ++body) {
        const std::vector<PointMass> acting(world.bodies.begin(), world.bodies.begin() + heavy_count);
        const Vector3d exact = acceleration_at(world.bodies[body].position, world.bodies[body].q, acting, 1);
        EXPECT_LE((world.acceleration(body) - exact).norm(), 0.02 * exact.norm()) << body;
    }
}

// Of a direct sum only what the heavy bodies exert on the light ones is left over: the sum of their forces.
TEST_P(GravityRegions, ForcesWithoutReactionAreSummedUp)
{
    evaluated({heavy(), light()});
    EXPECT_EQ(counts.unanswered, Vector3d(0, 0, 0));
    const AttractingWorld world = evaluated({heavy(), light()}, Attracts::OwnRegion);
    Vector3d left_over{0, 0, 0};
    double sizes = 0;
    for (std::size_t body = 0; body < world.bodies.size(); ++body) {
        left_over += world.bodies[body].mass * world.acceleration(body);
        sizes += world.bodies[body].mass * world.acceleration(body).norm();
    }
    EXPECT_GT(counts.unanswered.norm(), 1e-3 * sizes);
    // Forces within a region cancel but for the rounding of float pairs, or the error of the walk.
    EXPECT_LE((counts.unanswered - left_over).norm(), (GetParam() ? 1e-3 : 1e-6) * sizes);
}

TEST_P(GravityRegions, WhereFewActAllPairsAreSummedWhateverElseThereIs)
{
    AttractingWorld world({heavy(), light()});
    world.settings.direct_below = heavy_count + 1;
    world.view.regions[1].attracts = Attracts::Nothing;
    EXPECT_EQ(world.evaluate().groups, 0U);
    world.view.regions[1].attracts = Attracts::Everything;
    EXPECT_GT(world.evaluate().groups, 0U);
}

INSTANTIATE_TEST_SUITE_P(BothWays, GravityRegions, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Walked" : "Direct"; });

} // namespace
} // namespace slod::test
