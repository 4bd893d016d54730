#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/small_scenes.hpp"

// A particle that is thrown out of the range of numbers, among others.
namespace slod::test {
namespace {

constexpr std::uint64_t lost_id = 65;

/// A cloud, and one particle apart from it that flies away; without mass, as a body of mass is felt wherever
/// it is.
ParticleSet cloud_and_flyer(double speed)
{
    ParticleSet particles;
    add_cloud(particles, {.count = 64}, 3);
    particles.push_back({{1e4, 0, 0}, {speed, 0, 0}, lost_id, 0});
    return particles;
}

struct Ground {
    const char* name;
    Motion motion;
    double max_cluster_size;
    bool gravity;
    double allowed; ///< change of others' places
};

void PrintTo(const Ground& ground, std::ostream* out)
{
    *out << ground.name;
}

class AmongOthers : public testing::TestWithParam<Ground> {
protected:
    static SimulationSettings settings()
    {
        SimulationSettings settings = quiet_settings();
        settings.background.max_cluster_size = GetParam().max_cluster_size;
        settings.background.max_breadth = 20; // so that the flyer is alone in its cluster
        settings.motion.motion = GetParam().motion;
        settings.uniform_gravity = UniformGravitySettings{{0, 0, -1}};
        if (GetParam().gravity)
            settings.gravity.emplace();
        return settings;
    }
};

// The flyer is beyond the largest coordinate after a ninth of 64 frames; the one that it is compared with
// never is.
TEST_P(AmongOthers, N01_AParticleOutOfRangeIsTakenOutByNameAndNobodyElseIsTouched)
{
    constexpr int frames = 100;
    Simulation with(settings(), cloud_and_flyer(9e29), {}), without(settings(), cloud_and_flyer(1e6), {});
    Quarantined taken;
    std::uint64_t died = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const Snapshot& now = with.step({});
        without.step({});
        taken += now.quarantined;
        died += now.counts.died;
        ASSERT_EQ(with.problems(), Problems{}) << "frame " << frame;
    }
    expect_within("particles taken out", double(taken.particles), 1, 1);
    EXPECT_EQ(taken.first_ids.front(), lost_id);
    EXPECT_EQ(died, 1U);
    const ParticleSet here = with.particles(), there = without.particles();
    ASSERT_EQ(here.size(), 64U);
    ASSERT_EQ(there.size(), 65U);
    double largest = 0;
    for (std::size_t i = 0; i < here.size(); ++i)
        largest = worse(largest, (here[i].position - there[i].position).norm());
    expect_at_most(GetParam().allowed < 1 ? "largest change of another's place"
                                          : "likewise, of attracting clusters",
                   largest, GetParam().allowed);
}

// Attracting bodies see where the flyer is in the order of their sums, in float: 6e-8 of a pull of 1, over
// two units of time. Clusters of such bodies are formed of other members then.
constexpr double any = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(Scenes, AmongOthers,
                         testing::Values(Ground{"alone", Motion::Flow, 1, false, 0},
                                         Ground{"clustered", Motion::Flow, 8, false, 0},
                                         Ground{"rigid", Motion::Rigid, 8, false, 0},
                                         Ground{"attracting", Motion::Flow, 1, true, 1e-6},
                                         Ground{"attracting_clusters", Motion::Flow, 8, true, any},
                                         Ground{"attracting_rigid_clusters", Motion::Rigid, 8, true, any}),
                         [](const auto& scene) { return std::string(scene.param.name); });

// Forces in float would make everybody a number no more that saw it.
TEST(Quarantine, N01_TakesOutWhatIsBornOutOfRangeBeforeForcesSeeIt)
{
    SimulationSettings settings = quiet_settings();
    settings.gravity.emplace();
    settings.emitters = {jet("far")};
    settings.emitters.front().position = {1e28, 0, 0};
    ParticleSet cloud;
    add_cloud(cloud, {.count = 64}, 3);
    Simulation simulation(settings, cloud, {});
    std::uint64_t born = 0, taken = 0;
    for (int frame = 0; frame < 10; ++frame) {
        const Snapshot& now = simulation.step({});
        born += now.counts.born;
        taken += now.quarantined.particles;
        ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
    }
    EXPECT_GT(born, 0U);
    expect_within("taken out, of those born out of range", double(taken) / double(born), 1, 1);
    expect_within("of the others left, of 64", double(simulation.particles().size()), 64, 64);
}

// A body without weight comes near the heavy one in one step, and is thrown out by the kick that closes it;
// what forces are evaluated of does not show it any more.
TEST(Quarantine, N01_TakesOutWhatTheClosingKickThrowsOut)
{
    constexpr double far = 1e12, pull = 1e30, near = 1e-3;
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 1;
    settings.kinds.front().softening = 1e-3;
    settings.gravity.emplace();
    settings.gravity->strength = pull;
    const double step = settings.time.step, opening_kick = 0.5 * step * pull / (far * far);
    Simulation simulation(
        settings,
        {{{0, 0, 0}, {0, 0, 0}, 1, 1}, {{far, 0, 0}, {opening_kick - (far - near) / step, 0, 0}, lost_id, 0}},
        {});
    const Snapshot& now = simulation.step({});
    expect_within("particles taken out", double(now.quarantined.particles), 1, 1);
    EXPECT_EQ(now.quarantined.first_ids.front(), lost_id);
    EXPECT_EQ(simulation.problems(), Problems{});
}

// A field that is infinite where a particle is, within one frame.
TEST(Quarantine, N01_TakesAParticleThatAFieldThrowsOut)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 1;
    settings.fields.of<Spring>().push_back({.anchor = {0, 0, 0}, .stiffness = 1e30});
    ParticleSet particles = {{{0, 0, 0}, {0, 0, 0}, 1, 1}, {{1e20, 0, 0}, {0, 0, 0}, 2, 1}};
    Simulation simulation(settings, particles, {});
    const Snapshot& now = simulation.step({});
    expect_within("particles taken out", double(now.quarantined.particles), 1, 1);
    EXPECT_EQ(now.quarantined.first_ids.front(), 2U);
    EXPECT_EQ(simulation.particles().front().position, Vector3d(0, 0, 0));
}

} // namespace
} // namespace slod::test
