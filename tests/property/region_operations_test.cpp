#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "app/scene_editor.hpp"
#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "scene/value_text.hpp"
#include "support/random_regions.hpp"
#include "support/scratch_folder.hpp"
#include "support/small_scenes.hpp"
#include "support/totals.hpp"

namespace slod {
namespace {

constexpr std::size_t most_open = 12;

constexpr std::uint64_t fixed_life = 4;

/// One of the small scenes with parameters of its own. With odd seeds clusters that live by a clock live 4 to
/// 7 frames, and those of newborns move at their first particle's velocity.
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
    if (seed % 2 == 1) {
        scene.settings.motion.shortest_life = scene.settings.motion.longest_life = fixed_life;
        background.cluster_velocity = ClusterVelocity::First;
    }
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
        // Clusters that get their mean velocity back do so when their regions have been found.
        const bool steady = scene.settings.background.cluster_velocity == ClusterVelocity::Mean;
        draw_ = {.extent = 2, .size = 1.5, .by_mass = true, .by_motion = !scene.settings.gravity && steady};
    }

    void run(std::uint64_t count, bool checking)
    {
        for (std::uint64_t n = 0; n < count; ++n) {
            operate(n);
            if (n % 50 == 49)
                hashes_.push_back(hash());
            if (checking && n % 50 == 49)
                check();
        }
    }

    std::uint64_t hash() const { return simulation_.state_hash(); }
    const std::vector<std::uint64_t>& hashes() const { return hashes_; } ///< every fifty operations
    std::uint64_t placed() const { return placed_; } ///< clusters whose place midway through life was checked
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
        } else if (dice < 0.97) {
            changed.partition = partition(random);
            expect(editor_.change(changed, frames_ + 1));
        } else if (dice < 0.985) {
            editor_.set_detail(detail(random), frames_ + 1);
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
            settings.bin_by = std::array{BinBy::Mass, BinBy::Speed, BinBy::Acceleration}[random.bits() % 3];
        if (random.uniform() < 0.5)
            settings.cluster_velocity = ClusterVelocity::Mean;
        return settings;
    }

    static Detail detail(Random& random)
    {
        const auto factor = [&] { return 0.5 + 1.5 * random.uniform(); };
        Detail detail{.cluster_size = factor(), .breadth = factor(), .opening = factor(), .life = factor()};
        detail.dithered = random.uniform() < 0.5;
        return detail;
    }

    void expect(const Problems& problems, bool refused = false)
    {
        EXPECT_EQ(!problems.empty(), refused) << (problems.empty() ? "" : problems.front());
        refused_ += refused;
    }

    void check()
    {
        const auto& formed = simulation_.snapshot({.clusters = true}).clusters.formation;
        const std::uint64_t newest = formed.empty() ? 0 : *std::max_element(formed.begin(), formed.end());
        const Snapshot& now = step({.clusters = true, .conserved = true});
        ASSERT_EQ(simulation_.problems(), Problems{});
        const ParticleSet particles = simulation_.particles();
        ASSERT_EQ(particles.size(), now.counts.particles);
        for (std::size_t i = 1; i < particles.size(); ++i)
            ASSERT_LT(particles[i - 1].id, particles[i].id); // each is in exactly one cluster
        std::uint64_t held = 0;
        for (const RegionLoad& load : now.regions)
            held += load.particles;
        ASSERT_EQ(held, now.counts.particles);
        check_sums(now.conserved, particles);
        if (!simulation_.plan().clocked)
            check_precedence(now.clusters);
        else if (simulation_.settings().motion.longest_life == fixed_life &&
                 simulation_.settings().emitters.empty())
            check_formed(now.clusters, newest, fastest(particles));
    }

    static double fastest(const ParticleSet& particles)
    {
        double speed = 0;
        for (const Particle& particle : particles)
            speed = std::max(speed, particle.velocity.norm());
        return speed;
    }

    /// Mass and momentum of the clusters are those of the particles, each term rounded once on either way.
    static void check_sums(const ConservedQuantities& conserved, const ParticleSet& particles)
    {
        const ConservedQuantities sums = test::totals(particles);
        const double rounded = double(particles.size() + 64) * 0x1p-52 * sums.mass;
        ASSERT_NEAR(conserved.mass, sums.mass, rounded);
        ASSERT_LE((conserved.momentum - sums.momentum).norm(), rounded * fastest(particles));
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
            ASSERT_EQ(clusters.region[i], test::region_by_turns(in_order, subject))
                << clusters.position[i].transpose();
        }
    }

    /// Pools that live by a clock hold their clusters to the end of their lives; those formed in this frame
    /// are where their members will be midway through a life of 4 to 7 frames, 2.75 on and 0.75 to either
    /// side, and boxes and balls have with all members their mean. The last half kick is not to count: what
    /// is a twelfth of the fastest particle's velocity carries another 0.25 frames far.
    void check_formed(const ClusterStates& clusters, std::uint64_t newest, double fastest)
    {
        const double step = simulation_.settings().time.step;
        for (Simulation::Region region : simulation_.regions()) {
            RegionOfInterest& wider = region.settings;
            const bool convex = wider.shape == Shape::Box || wider.shape == Shape::Sphere;
            if (!convex || RegionTest(wider).selective())
                continue;
            wider.half_extent.array() += step * fastest;
            wider.radius += step * fastest;
            const RegionTest test(wider);
            for (std::size_t i = 0; i < clusters.size(); ++i) {
                if (clusters.region[i] != region.row || clusters.formation[i] <= newest)
                    continue;
                const Vector3d midway = clusters.position[i] + 2.75 * step * clusters.velocity[i];
                ASSERT_TRUE(test.contains(midway)) << midway.transpose();
                ++placed_;
            }
        }
    }

    Simulation simulation_;
    SceneEditor editor_;
    std::uint64_t seed_;
    test::RegionDraw draw_;
    std::uint64_t frames_ = 0, refused_ = 0, placed_ = 0;
    std::vector<std::uint64_t> hashes_;
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
    /// Puts the scene of a seed through its operations, with so many threads; returns the hashes on the way.
    static std::vector<std::uint64_t> hashes(std::uint64_t operations, std::uint64_t seed, int threads)
    {
        std::vector<std::uint64_t> result;
        ThreadTeam team(threads);
        team.run([&] {
            Ordeal ordeal(random_scene(GetParam().scene, seed), seed);
            ordeal.run(operations, false);
            result = ordeal.hashes();
        });
        return result;
    }
};

TEST_P(RegionOperations, KeepEveryParticleInTheClusterAndEveryClusterWherePrecedenceSays)
{
    ThreadTeam team(2);
    team.run([] {
        // Fewer where every structure is checked after each phase.
        const std::uint64_t operations = GetParam().operations / (validating ? 8 : 1);
        std::uint64_t placed = 0;
        for (std::uint64_t seed = 1; seed <= GetParam().seeds; ++seed) {
            SCOPED_TRACE(seed);
            Ordeal ordeal(random_scene(GetParam().scene, seed), seed);
            ordeal.run(operations, true);
            EXPECT_GT(ordeal.refused(), 0U);
            placed += ordeal.placed();
        }
        EXPECT_EQ(placed > 0, std::string_view(GetParam().scene) == "flow");
    });
}

TEST_P(RegionOperations, GiveTheSameBitsWithAnyNumberOfThreads)
{
    const std::uint64_t operations = GetParam().operations / 8;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const std::vector<std::uint64_t> alone = hashes(operations, seed, 1);
        ASSERT_EQ(alone.size(), operations / 50);
        EXPECT_EQ(hashes(operations, seed, 3), alone) << seed;
        EXPECT_EQ(hashes(operations, seed, 8), alone) << seed;
    }
}

/// Puts the scene of a seed through its operations, and a new one through what the log says of them.
void expect_repeated(const char* name, std::uint64_t seed, std::uint64_t operations)
{
    const ScratchFolder folder;
    const test::SmallScene scene = random_scene(name, seed);
    Ordeal ordeal(scene, seed);
    ordeal.run(operations, true);
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
    EXPECT_GT(log.commands.size(), operations / 5);
    EXPECT_EQ(again.state_hash(), log.end->state_hash);
}

TEST_P(RegionOperations, AreRepeatedFromTheirLog)
{
    for (const std::uint64_t seed : {2U, 3U}) {
        SCOPED_TRACE(seed);
        expect_repeated(GetParam().scene, seed, GetParam().operations / 8);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RegionOperations,
                         testing::Values(Trial{"fountain", 5, 9'000}, Trial{"rigid_fountain", 5, 9'000},
                                         Trial{"obstacles", 2, 1'500}, Trial{"rigid_obstacles", 2, 1'500},
                                         Trial{"flow", 2, 1'800}, Trial{"mixture", 2, 1'800}),
                         [](const auto& scene) { return std::string(scene.param.scene); });

} // namespace
} // namespace slod
