#include <cmath>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/falling_particle.hpp"
#include "support/meshes.hpp"
#include "support/one_cluster.hpp"
#include "support/solids.hpp"

// Rain on hills of triangles, as a mesh, as a field of heights and as a grid of distances.
namespace slod::test {
namespace {

ColliderSettings hills(ColliderShape shape)
{
    ColliderSettings settings = with(sheet(hilly_mesh()), 0.3, 0.2);
    if (shape == ColliderShape::Heightfield) {
        settings =
            with(sheet(grid_mesh(9, 9, 1, [](auto x, auto y) { return hill(int(x), int(y)); })), 0.3, 0.2);
        settings.shape = shape;
        settings.spacing = 0.5;
    } else if (shape == ColliderShape::DistanceGrid) {
        settings = with(sheet(hilly_grid()), 0.3, 0.2);
    }
    settings.name = "hills";
    return settings;
}

/// Above the hills, within their rims; of six one above an edge along x, one along y, one above a diagonal
/// and one above a vertex.
Vector3d above(std::uint64_t i, Random& random)
{
    double x = 0.5 + 3 * random.uniform(), y = 0.5 + 3 * random.uniform();
    const auto on_line = [](double z) { return 0.5 * std::round(2 * z); };
    if (i % 6 == 1 || i % 6 == 3)
        x = on_line(x);
    if (i % 6 == 2 || i % 6 == 3)
        y = on_line(y);
    if (i % 6 == 4)
        y = on_line(y) + std::fmod(x, 0.5) - (on_line(y) > 3 ? 0.5 : 0);
    return {x, y, 0.8 + 0.2 * random.uniform()};
}

bool leaked(const Vector3d& x)
{
    const std::optional<double> ground = hilly_height(x);
    return !x.allFinite() || (ground && x.z() <= *ground);
}

class Rain : public testing::TestWithParam<ColliderShape> {};

// Half of them straight down, and all as fast as to be there in 1 to 6 of 10 frames.
TEST_P(Rain, F22_ADropNeverLeaks)
{
    const Colliders colliders({hills(GetParam())}, falling(), frame);
    constexpr std::uint64_t drops = 500'000;
    std::uint64_t leaks = 0, struck = 0;
    for (std::uint64_t i = 0; i < drops; ++i) {
        Random random(22, 0, i);
        State drop{above(i, random), {0, 0, -10 - 40 * random.uniform()}};
        if (i / 6 % 2 == 0)
            drop.velocity += 5 * random_direction(random);
        bool met = false;
        for (int step = 0; step < 10; ++step)
            met = colliders.fly(drop.position, drop.velocity, frame).impacts > 0 || met;
        leaks += leaked(drop.position) ? 1 : 0;
        struck += met ? 1 : 0;
    }
    expect_at_most("drops through, of 500,000", double(leaks), 0);
    expect_at_least("drops that struck, share", double(struck) / drops, 0.99); // some fly off the rims
}

// Clusters of 64 that a floor takes apart, at the same seams.
TEST_P(Rain, F22_NoMemberOfAClusterLeaks)
{
    for (const Crowd& crowd : crowds()) {
        SimulationSettings settings = settings_for(crowd);
        settings.time.step = frame;
        settings.background.max_cluster_size = double(crowd.particles);
        settings.background.max_breadth = 0.5;
        settings.uniform_gravity = UniformGravitySettings{{0, 0, -fall}};
        settings.colliders = {hills(GetParam())};
        ParticleSet rain;
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            Random random(23, 0, i);
            rain.push_back({above(i, random), {0, 0, -10}, i + 1, 1});
        }
        Simulation simulation(settings, rain, {});
        std::uint64_t impacts = 0;
        int leaks = 0;
        for (int step = 0; step < 20; ++step)
            impacts += simulation.step({}).counts.impacts;
        for (const Particle& particle : simulation.particles())
            leaks += leaked(particle.position) ? 1 : 0;
        expect_at_most("particles through, of 20,000", leaks, 0);
        EXPECT_GE(impacts, rain.size());
    }
}

std::string shape_of(const testing::TestParamInfo<ColliderShape>& info)
{
    return std::string(names(info.param)[std::size_t(info.param)]);
}

INSTANTIATE_TEST_SUITE_P(Hills, Rain,
                         testing::Values(ColliderShape::Mesh, ColliderShape::Heightfield,
                                         ColliderShape::DistanceGrid),
                         shape_of);

} // namespace
} // namespace slod::test
