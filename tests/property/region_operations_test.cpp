#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/random_regions.hpp"
#include "support/small_scenes.hpp"

namespace slod {
namespace {

constexpr std::size_t most_open = 12;

/// A scene at the mercy of one random operation after another; the n-th depends on the seed, n and what was
/// done before, on nothing else.
class Ordeal {
public:
    explicit Ordeal(const test::SmallScene& scene) : simulation_(scene.settings, scene.initial, {})
    {
        draw_ = {.extent = 2, .size = 1.5, .by_mass = true, .by_motion = !scene.settings.gravity};
    }

    void run(std::uint64_t count, bool checking)
    {
        for (std::uint64_t n = 0; n < count; ++n) {
            operate(n);
            if (checking && n % 50 == 49)
                check();
        }
    }

    std::uint64_t hash() const { return simulation_.state_hash(); }
    std::uint64_t refused() const { return refused_; }

private:
    void operate(std::uint64_t n)
    {
        Random random(17, 0, n);
        const double dice = random.uniform();
        const auto regions = simulation_.regions();
        const Simulation::Region& one = regions[random.bits() % regions.size()];
        RegionOfInterest changed = one.settings;
        if (dice < 0.5) {
            simulation_.step({});
        } else if (dice < 0.62) {
            if (regions.size() > most_open)
                return;
            RegionOfInterest added = test::random_region(random, draw_);
            added.name = "r" + std::to_string(n);
            added.partition = partition(random);
            expect(simulation_.add_region(added));
        } else if (dice < 0.72) {
            expect(simulation_.remove_region(one.settings.name), one.row == background_row);
        } else if (dice < 0.86) {
            changed.centre = test::random_point(random, draw_.extent);
            expect(simulation_.change_region(changed));
        } else if (dice < 0.92) {
            changed.half_extent *= 2 * random.uniform();
            changed.radius *= 2 * random.uniform();
            expect(simulation_.change_region(changed));
        } else if (dice < 0.98) {
            changed.partition = partition(random);
            expect(simulation_.change_region(changed));
        } else {
            SimulationSettings settings = simulation_.settings();
            if (settings.gravity)
                settings.gravity->strength = 0.8 + 0.4 * random.uniform();
            if (settings.uniform_wind)
                settings.uniform_wind->velocity = test::random_point(random, 2);
            expect(simulation_.change_settings(settings));
        }
    }

    RegionSettings partition(Random& random) const
    {
        RegionSettings settings = simulation_.settings().background;
        settings.max_cluster_size = 1 + double(random.bits() % 64);
        if (random.uniform() < 0.5)
            settings.max_breadth = 0.2 + random.uniform();
        if (random.uniform() < 0.2)
            settings.bin_by = draw_.by_motion ? BinBy::Speed : BinBy::Mass;
        return settings;
    }

    void expect(const Problems& problems, bool refused = false)
    {
        EXPECT_EQ(!problems.empty(), refused) << (problems.empty() ? "" : problems.front());
        refused_ += refused;
    }

    void check()
    {
        const Snapshot& now = simulation_.step({.clusters = true});
        ASSERT_EQ(simulation_.problems(), Problems{});
        const ParticleSet particles = simulation_.particles();
        ASSERT_EQ(particles.size(), now.counts.particles);
        for (std::size_t i = 1; i < particles.size(); ++i)
            ASSERT_LT(particles[i - 1].id, particles[i].id); // each is in exactly one cluster
        std::uint64_t held = 0;
        for (const RegionLoad& load : now.regions)
            held += load.particles;
        ASSERT_EQ(held, now.counts.particles);
        check_precedence(now.clusters);
    }

    void check_precedence(const ClusterStates& clusters)
    {
        std::vector<RegionIndex::Entry> in_order;
        for (const Simulation::Region& region : simulation_.regions())
            in_order.push_back({region.row, RegionTest(region.settings)});
        in_order.pop_back(); // the background
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            const double mass = clusters.mass[i] / clusters.count[i];
            const Subject subject(clusters.position[i], mass, clusters.velocity[i].norm());
            // Pools that live by a clock hold their clusters to the end of their lives.
            const RegionRow due =
                simulation_.plan().clocked ? clusters.region[i] : test::region_by_turns(in_order, subject);
            ASSERT_EQ(clusters.region[i], due) << clusters.position[i].transpose();
            const auto open = [&](const RegionIndex::Entry& entry) {
                return entry.row == clusters.region[i];
            };
            ASSERT_TRUE(clusters.region[i] == background_row ||
                        std::any_of(in_order.begin(), in_order.end(), open));
        }
    }

    Simulation simulation_;
    test::RegionDraw draw_;
    std::uint64_t refused_ = 0;
};

/// Of a hundred thousand in all, fewer where gravity makes each step dear.
struct Trial {
    const char* scene;
    std::uint64_t operations;
};

class RegionOperations : public testing::TestWithParam<Trial> {};

TEST_P(RegionOperations, KeepEveryParticleInTheClusterAndEveryClusterWherePrecedenceSays)
{
    ThreadTeam team(2);
    team.run([] {
        Ordeal ordeal(test::small_scene(GetParam().scene));
        ordeal.run(GetParam().operations, true);
        EXPECT_GT(ordeal.refused(), 0U);
    });
}

TEST_P(RegionOperations, GiveTheSameBitsWithAnyNumberOfThreads)
{
    const auto hash = [](int threads) {
        std::uint64_t result = 0;
        ThreadTeam team(threads);
        team.run([&] {
            Ordeal ordeal(test::small_scene(GetParam().scene));
            ordeal.run(GetParam().operations / 5, false);
            result = ordeal.hash();
        });
        return result;
    };
    const std::uint64_t alone = hash(1);
    EXPECT_EQ(hash(3), alone);
    EXPECT_EQ(hash(8), alone);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RegionOperations,
                         testing::Values(Trial{"fountain", 45'000}, Trial{"rigid_fountain", 45'000},
                                         Trial{"flow", 4'000}, Trial{"mixture", 6'000}),
                         [](const auto& scene) { return std::string(scene.param.scene); });

} // namespace
} // namespace slod
