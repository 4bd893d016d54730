#include <algorithm>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "app/scene_editor.hpp"
#include "core/parallel.hpp"
#include "scene/value_text.hpp"
#include "support/random_regions.hpp"
#include "support/scratch_folder.hpp"
#include "support/small_scenes.hpp"

namespace slod {
namespace {

constexpr std::size_t most_open = 12;

/// One of the small scenes with parameters of its own.
test::SmallScene random_scene(const std::string& name, std::uint64_t seed)
{
    test::SmallScene scene = test::small_scene(name);
    Random random(seed, 1, 0);
    const auto factor = [&] { return 0.5 + random.uniform(); };
    scene.settings.seed = seed;
    scene.settings.motion.clock *= factor();
    RegionSettings& background = scene.settings.background;
    background.max_cluster_size = 2 + double(random.bits() % 62);
    background.pool_factor = 1 + 3 * random.uniform();
    background.max_breadth *= factor();
    for (EmitterSettings& emitter : scene.settings.emitters) {
        emitter.rate *= factor();
        emitter.lifetime *= factor();
    }
    return scene;
}

/// A scene at the mercy of one random operation after another; the n-th depends on the seed, n and what was
/// done before, on nothing else.
class Ordeal {
public:
    Ordeal(const test::SmallScene& scene, std::uint64_t seed)
        : simulation_(scene.settings, scene.initial, {}), editor_(simulation_), seed_(seed)
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
    std::uint64_t frames() const { return frames_; }
    std::vector<LoggedCommand> take_log() { return editor_.take_log(); }

private:
    const Snapshot& step(const Simulation::Request& request)
    {
        ++frames_;
        return simulation_.step(request);
    }

    void operate(std::uint64_t n)
    {
        Random random(seed_, 0, n);
        const double dice = random.uniform();
        const auto regions = simulation_.regions();
        const Simulation::Region& one = regions[random.bits() % regions.size()];
        RegionOfInterest changed = one.settings;
        if (dice < 0.5) {
            step({});
        } else if (dice < 0.62) {
            if (regions.size() > most_open)
                return;
            RegionOfInterest added = test::random_region(random, draw_);
            added.name = "r" + std::to_string(n);
            added.partition = partition(random);
            expect(editor_.add(added, {}, 0, frames_ + 1));
        } else if (dice < 0.72) {
            expect(editor_.remove(one.settings.name, frames_ + 1), one.row == background_row);
        } else if (dice < 0.86) {
            changed.centre = test::random_point(random, draw_.extent);
            expect(editor_.change(changed, frames_ + 1));
        } else if (dice < 0.92) {
            changed.half_extent *= 2 * random.uniform();
            changed.radius *= 2 * random.uniform();
            expect(editor_.change(changed, frames_ + 1));
        } else if (dice < 0.98) {
            changed.partition = partition(random);
            expect(editor_.change(changed, frames_ + 1));
        } else {
            const SimulationSettings& settings = simulation_.settings();
            if (settings.gravity)
                expect(editor_.set({{"gravity.strength", value_text(0.8 + 0.4 * random.uniform())}},
                                   frames_ + 1));
            if (settings.uniform_wind)
                expect(editor_.set({{"uniform_wind.velocity", value_text(test::random_point(random, 2))}},
                                   frames_ + 1));
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
        const Snapshot& now = step({.clusters = true});
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
    SceneEditor editor_;
    std::uint64_t seed_;
    test::RegionDraw draw_;
    std::uint64_t frames_ = 0, refused_ = 0;
};

/// So many operations on a scene of each seed: a hundred thousand in all, fewer where gravity makes each step
/// dear.
struct Trial {
    const char* scene;
    std::uint64_t seeds, operations;
};

void PrintTo(const Trial& trial, std::ostream* out)
{
    *out << trial.scene;
}

class RegionOperations : public testing::TestWithParam<Trial> {
protected:
    /// Puts the scene of a seed through its operations, with so many threads; returns the last hash.
    static std::uint64_t hash_after(std::uint64_t operations, std::uint64_t seed, int threads)
    {
        std::uint64_t result = 0;
        ThreadTeam team(threads);
        team.run([&] {
            Ordeal ordeal(random_scene(GetParam().scene, seed), seed);
            ordeal.run(operations, false);
            result = ordeal.hash();
        });
        return result;
    }
};

TEST_P(RegionOperations, KeepEveryParticleInTheClusterAndEveryClusterWherePrecedenceSays)
{
    ThreadTeam team(2);
    team.run([] {
        for (std::uint64_t seed = 1; seed <= GetParam().seeds; ++seed) {
            SCOPED_TRACE(seed);
            Ordeal ordeal(random_scene(GetParam().scene, seed), seed);
            ordeal.run(GetParam().operations, true);
            EXPECT_GT(ordeal.refused(), 0U);
        }
    });
}

TEST_P(RegionOperations, GiveTheSameBitsWithAnyNumberOfThreads)
{
    const std::uint64_t operations = GetParam().operations / 4;
    const std::uint64_t alone = hash_after(operations, 1, 1);
    EXPECT_EQ(hash_after(operations, 1, 3), alone);
    EXPECT_EQ(hash_after(operations, 1, 8), alone);
}

TEST_P(RegionOperations, AreRepeatedFromTheirLog)
{
    const ScratchFolder folder;
    const test::SmallScene scene = random_scene(GetParam().scene, 2);
    Ordeal ordeal(scene, 2);
    ordeal.run(GetParam().operations / 4, true);
    InputLogWriter writer(folder.path(), {});
    for (const LoggedCommand& command : ordeal.take_log())
        writer.record(command);
    writer.finish({ordeal.frames(), ordeal.hash()});
    const auto read = read_input_log(folder.path() / "input.log");
    ASSERT_TRUE(std::holds_alternative<InputLog>(read)) << std::get<Problems>(read).front();
    const InputLog& log = std::get<InputLog>(read);

    Simulation again(scene.settings, scene.initial, {});
    SceneEditor editor(again);
    auto command = log.commands.begin();
    for (std::uint64_t frame = 1; frame <= log.end->frames + 1; ++frame) {
        for (; command != log.commands.end() && command->frame == frame; ++command)
            ASSERT_EQ(editor.repeat(*command), Problems{}) << "frame " << frame;
        if (frame <= log.end->frames)
            again.step({});
    }
    EXPECT_TRUE(command == log.commands.end());
    EXPECT_GT(log.commands.size(), GetParam().operations / 20);
    EXPECT_EQ(again.state_hash(), log.end->state_hash);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RegionOperations,
                         testing::Values(Trial{"fountain", 5, 9'000}, Trial{"rigid_fountain", 5, 9'000},
                                         Trial{"flow", 2, 2'000}, Trial{"mixture", 3, 2'000}),
                         [](const auto& scene) { return std::string(scene.param.scene); });

} // namespace
} // namespace slod
