#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "effects/emitter.hpp"
#include "support/clouds.hpp"
#include "support/random_regions.hpp"
#include "support/rigid_scenes.hpp"

// O'Brien, Fisher, Lin 2001, section 5.1: emitters, and how many regions are too many.
namespace slod::test {
namespace {

/// Root mean square distance from the axis of what an upright jet threw out a unit of time ago.
double stream_width(const SimulationSettings& settings)
{
    Simulation simulation(settings, {}, {});
    run(simulation, 96); // one and a half units of time
    double sum = 0;
    int count = 0;
    for (const Particle& particle : simulation.particles()) {
        const auto number = double(particle.id & ((std::uint64_t{1} << Emitter::id_shift) - 1));
        const double age = 1.5 - number / settings.emitters[0].rate;
        if (std::abs(age - 1) > 0.25)
            continue;
        sum += particle.position.x() * particle.position.x() + particle.position.y() * particle.position.y();
        ++count;
    }
    return std::sqrt(sum / count);
}

TEST(Paper, A47_AFineRegionAroundAnEmitterKeepsTheStreamAsWideAsItIs)
{
    SimulationSettings settings = rigid_settings(1);
    settings.emitters = {jet("jet")};
    settings.emitters[0].lifetime = 4;
    settings.emitters[0].rate = 1280;
    const double exact = stream_width(settings);
    settings.background.max_cluster_size = 16;
    settings.background.max_breadth = 0.25;
    settings.background.speed_ratio = 1.1;
    settings.background.angle_deg = 3;
    const double grouped_at_once = stream_width(settings);
    settings.regions = {ball_region("spring", {0, 0, 0}, 2, 1)};
    const double grouped_later = stream_width(settings);
    EXPECT_LT(grouped_at_once, 0.8 * exact) << "velocities are averaged before they part";
    EXPECT_NEAR(grouped_later, exact, 0.02 * exact);
}

/// Boundary tests per look-up in a world where `count` small regions are strewn.
double tests_per_lookup(std::size_t count)
{
    Random random(51, 0, 0);
    const double extent = 2 * std::cbrt(double(count)); // the same share of space is taken
    std::vector<RegionIndex::Entry> entries;
    for (RegionRow row = 1; row <= count; ++row)
        entries.push_back({row, RegionTest(ball_region("one", random_point(random, extent), 1, 4))});
    RegionIndex index;
    index.assign(entries);
    std::uint64_t tests = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Subject subject(random_point(random, extent));
        EXPECT_EQ(index.find(subject, &tests), region_by_turns(entries, subject));
    }
    return double(tests) / 10'000;
}

// The paper gives up when there are too many crucial areas.
TEST(Paper, A51_AThousandRegionsCostLittleMoreThanTen)
{
    EXPECT_LT(tests_per_lookup(1000), 2 * tests_per_lookup(10));
}

} // namespace
} // namespace slod::test
