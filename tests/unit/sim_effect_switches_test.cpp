#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/clouds.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"

// Effects that come, go and change while the scene runs.
namespace slod::test {
namespace {

std::string name_of(const testing::TestParamInfo<SmallScene>& info)
{
    return info.param.name;
}

std::vector<std::string> effects_of(const SimulationSettings& settings)
{
    std::vector<std::string> names;
    for_each_effect(settings, [&](std::string_view name, const auto& table) {
        if (named(table))
            names.emplace_back(name);
    });
    return names;
}

Problems turn(Simulation& simulation, std::string_view effect, bool on)
{
    SimulationSettings wanted = simulation.settings();
    wanted.effects.on[effect_row(effect)] = on;
    return simulation.change_settings(wanted);
}

std::string_view state_of(const Simulation& simulation, std::string_view effect)
{
    return simulation.plan().effects[effect_row(effect)].state();
}

/// Largest difference of places, in units of the largest of them: those of the same ids.
double farthest(const ParticleSet& a, const ParticleSet& b)
{
    double farthest = 0, extent = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].id, b[i].id);
        farthest = std::max(farthest, (a[i].position - b[i].position).norm());
        extent = std::max(extent, a[i].position.norm());
    }
    return farthest / extent;
}

class Switches : public testing::TestWithParam<SmallScene> {};

// Members' offsets are kept in single precision, of half a unit in the 24th place of the cluster's breadth.
TEST_P(Switches, OffLeavesNoWorkAndNobodyElsewhereAndOnTakesItUpAgain)
{
    for (const std::string& effect : effects_of(GetParam().settings)) {
        SCOPED_TRACE(effect);
        Simulation simulation(GetParam().settings, GetParam().initial, {});
        run(simulation, 10);
        const bool ran = state_of(simulation, effect) == "active";
        const ParticleSet before = simulation.particles();
        if (const Problems refused = turn(simulation, effect, false); !refused.empty()) {
            EXPECT_NE(refused.front().find("drag"), std::string::npos) << refused.front();
            continue; // winds would have nothing to act through
        }
        EXPECT_EQ(state_of(simulation, effect), "off");
        const ParticleSet after = simulation.particles();
        ASSERT_EQ(after.size(), before.size());
        EXPECT_LE(farthest(before, after), 1e-6);
        for (int frame = 0; frame < 10; ++frame) {
            const EffectWork& work = simulation.step({}).effects[effect_row(effect)];
            EXPECT_EQ(work.clusters + work.particles, 0U);
        }
        EXPECT_EQ(simulation.problems(), Problems{});
        ASSERT_EQ(turn(simulation, effect, true), Problems{});
        EXPECT_EQ(state_of(simulation, effect) == "active", ran);
        run(simulation, 10);
        EXPECT_EQ(simulation.problems(), Problems{});
        EXPECT_EQ(simulation.snapshot({}).frame, 30U);
    }
}

TEST_P(Switches, GiveTheSameBitsAtAnyNumberOfThreads)
{
    const auto hash = [&](int threads) {
        std::uint64_t outcome = 0;
        ThreadTeam(threads).run([&] {
            Simulation simulation(GetParam().settings, GetParam().initial, {});
            for (const std::string& effect : effects_of(GetParam().settings)) {
                run(simulation, 3);
                turn(simulation, effect, false);
                run(simulation, 3);
                turn(simulation, effect, true);
            }
            outcome = simulation.state_hash();
        });
        return outcome;
    };
    EXPECT_EQ(hash(3), hash(1));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Switches, testing::ValuesIn(small_scenes()), name_of);

TEST(EffectSwitches, AreOfEveryEffectInThePlansOrder)
{
    const Plan plan = compile_plan(quiet_settings(), {});
    ASSERT_EQ(plan.effects.size(), effect_count);
    for (std::size_t row = 0; row < effect_count; ++row)
        EXPECT_EQ(plan.effects[row].name, effect_names[row]);
}

/// Single particles among an attractor, a vortex and a wind in a box.
SmallScene among_fields()
{
    SmallScene scene{"among_fields", quiet_settings(), ball(200, 1, 1, 3)};
    scene.settings.background.max_cluster_size = 1;
    scene.settings.linear_drag = LinearDragSettings{0.3};
    scene.settings.fields.of<Attractor>() = {{.position = {1, 0, 0}}};
    scene.settings.fields.of<Vortex>() = {VortexSettings{}};
    scene.settings.fields.of<Wind>() = {WindSettings{}};
    return scene;
}

// Whoever moves an attractor moves it from frame to frame: nothing is formed anew, and the next frame has it.
TEST(EffectSwitches, ValuesOfEffectsOfPlaceAreTakenAsTheyAre)
{
    const SmallScene scene = among_fields();
    SimulationSettings other = scene.settings;
    other.fields.of<Attractor>()[0].position = {0, 2, 0};
    other.fields.of<Vortex>()[0].strength = -3;
    other.fields.of<Wind>()[0].velocity = {0, 5, 0};
    Simulation changed(scene.settings, scene.initial, {}), from_start(other, scene.initial, {}),
        unchanged(scene.settings, scene.initial, {});
    ASSERT_EQ(changed.change_settings(other), Problems{});
    for (Simulation* const each : {&changed, &from_start, &unchanged})
        run(*each, 20);
    EXPECT_EQ(changed.state_hash(), from_start.state_hash());
    EXPECT_NE(changed.state_hash(), unchanged.state_hash());
}

/// Scenes where emitters, colliders and clocks follow what differs from place to place.
class ChangingValues : public testing::TestWithParam<SmallScene> {};

// Each frame has other strengths, and one in which an effect has none.
TEST_P(ChangingValues, FormNothingAnewAndGiveTheSameBitsAtAnyNumberOfThreads)
{
    const auto outcome = [&](int threads) {
        std::uint64_t hash = 0;
        ThreadTeam(threads).run([&] {
            Simulation simulation(GetParam().settings, GetParam().initial, {});
            run(simulation, 2);
            const Plan plan = simulation.plan();
            SimulationSettings wanted = GetParam().settings;
            if (auto& attractors = wanted.fields.of<Attractor>(); !attractors.empty())
                attractors.push_back({.strength = 0});
            for (int frame = 0; frame < 40; ++frame) {
                const auto turn = [&](double& strength) { strength *= frame % 2 == 0 ? 1.25 : 0.8; };
                for (AttractorSettings& attractor : wanted.fields.of<Attractor>())
                    turn(attractor.strength);
                for (WindSettings& wind : wanted.fields.of<Wind>())
                    turn(wind.velocity.x());
                if (auto& eddies = wanted.fields.of<Turbulence>())
                    turn(eddies->amplitude);
                const ParticleSet before = simulation.particles();
                EXPECT_EQ(simulation.change_settings(wanted), Problems{});
                EXPECT_EQ(farthest(before, simulation.particles()), 0)
                    << "to form clusters anew rounds places";
                run(simulation, 1);
                ASSERT_EQ(simulation.problems(), Problems{}) << frame;
            }
            EXPECT_TRUE(simulation.plan() == plan);
            hash = simulation.state_hash();
        });
        return hash;
    };
    const std::uint64_t alone = outcome(1);
    EXPECT_EQ(outcome(3), alone);
    EXPECT_NE(alone, hash_of(GetParam())) << "or else nothing was changed";
}

INSTANTIATE_TEST_SUITE_P(Scenes, ChangingValues,
                         testing::Values(small_scene("fields"), small_scene("attracted_fields"),
                                         small_scene("winds"), small_scene("winds_among_obstacles"),
                                         small_scene("gusts")),
                         name_of);

TEST(EffectSwitches, FilesOfCollidersStay)
{
    const SmallScene scene = small_scene("meshes");
    Simulation simulation(scene.settings, scene.initial, {});
    const auto refused = [&](const ColliderSettings& collider, const std::string& key) {
        SimulationSettings wanted = simulation.settings();
        wanted.colliders[1] = collider;
        const Problems found = simulation.change_settings(wanted);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_TRUE(found.front().starts_with(key + " cannot change")) << found.front();
    };
    ColliderSettings heights = scene.settings.colliders[1];
    heights.shape = ColliderShape::Heightfield;
    refused(heights, "collider.1.shape");
    refused({.name = "bowl", .shape = ColliderShape::Mesh, .file = "bowl.obj"}, "collider.1.file");
    ColliderSettings turned = scene.settings.colliders[1];
    turned.rotation = {0, 0, 45};
    SimulationSettings wanted = simulation.settings();
    wanted.colliders[1] = turned;
    EXPECT_EQ(simulation.change_settings(wanted), Problems{});
}

// What flies on without the field flies straight.
TEST(EffectSwitches, WithoutUniformGravityParticlesGoOnStraight)
{
    SimulationSettings settings = quiet_settings();
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -9.81}};
    Simulation simulation(settings, ball(500, 1, 1, 3), {});
    run(simulation, 16);
    const ParticleSet before = simulation.particles();
    ASSERT_EQ(turn(simulation, "uniform_gravity", false), Problems{});
    run(simulation, 64);
    ParticleSet straight = before;
    for (Particle& particle : straight)
        particle.position += 64 * settings.time.step * particle.velocity;
    EXPECT_LE(farthest(straight, simulation.particles()), 1e-6);
}

TEST(EffectSwitches, RegionsStayInTheirRowsWithWhatIsInThem)
{
    SmallScene scene = small_scene("rigid");
    Simulation simulation(scene.settings, scene.initial, {});
    ASSERT_EQ(simulation.add_region(ball_region("first", {0, 0, 0}, 0.5, 4)), Problems{});
    ASSERT_EQ(simulation.add_region(ball_region("second", {1, 0, 0}, 0.5, 8)), Problems{});
    run(simulation, 5);
    ASSERT_EQ(simulation.remove_region("first"), Problems{});
    run(simulation, 20);
    const RegionRow row = simulation.regions().front().row;
    EXPECT_GT(row, 1);
    ASSERT_EQ(turn(simulation, "gravity", false), Problems{});
    ASSERT_EQ(simulation.regions().size(), 2U);
    EXPECT_EQ(simulation.regions().front().row, row);
    run(simulation, 5);
    EXPECT_EQ(simulation.problems(), Problems{});
    EXPECT_GT(simulation.snapshot({}).regions.front().particles, 0U);
}

// Identities of clusters mean one cluster for good.
TEST(EffectSwitches, NoClusterGetsTheIdentityOfAnEarlierOne)
{
    SmallScene scene = small_scene("flow");
    Simulation simulation(scene.settings, scene.initial, {});
    std::set<std::pair<std::uint32_t, std::uint32_t>> ids;
    std::set<std::uint64_t> formations;
    const auto note_all = [&] {
        const ClusterStates& states = simulation.snapshot({.clusters = true}).clusters;
        for (std::size_t i = 0; i < states.size(); ++i) {
            EXPECT_TRUE(ids.emplace(states.id[i].slot.index, states.id[i].generation).second);
            EXPECT_TRUE(formations.insert(states.formation[i]).second);
        }
    };
    note_all();
    for (const bool on : {false, true}) {
        ASSERT_EQ(turn(simulation, "gravity", on), Problems{});
        note_all();
    }
}

TEST(EffectSwitches, AnEmitterThatWasOffGoesOnWithNewParticles)
{
    SmallScene scene = small_scene("fountain");
    Simulation simulation(scene.settings, scene.initial, {});
    run(simulation, 10);
    ASSERT_EQ(turn(simulation, "emitter", false), Problems{});
    EXPECT_EQ(run(simulation, 10).counts.born, 0U);
    const std::size_t alive = simulation.particles().size();
    ASSERT_EQ(turn(simulation, "emitter", true), Problems{});
    EXPECT_GT(run(simulation, 10).counts.born, 0U);
    std::set<std::uint64_t> ids;
    for (const Particle& particle : simulation.particles())
        EXPECT_TRUE(ids.insert(particle.id).second);
    EXPECT_GT(ids.size(), alive);
}

TEST(EffectSwitches, AnEffectThatTheSceneHadNotComesWhileItRuns)
{
    Simulation simulation(quiet_settings(), ball(500, 1, 1, 3), {});
    run(simulation, 5);
    SimulationSettings wanted = simulation.settings();
    wanted.quadratic_drag = QuadraticDragSettings{.coefficient = 2};
    const double before = simulation.snapshot({.conserved = true}).conserved.kinetic_energy;
    ASSERT_EQ(simulation.change_settings(wanted), Problems{});
    EXPECT_NEAR(simulation.snapshot({.conserved = true}).conserved.kinetic_energy, before, 1e-6 * before);
    run(simulation, 64);
    EXPECT_LT(simulation.snapshot({.conserved = true}).conserved.kinetic_energy, 0.8 * before);
}

TEST(EffectSwitches, OfWhatTheSceneDoesNotHaveAreRefused)
{
    SimulationSettings settings = quiet_settings();
    settings.effects.on[effect_row("vortex")] = false;
    const Problems found = problems(settings);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found.front().starts_with("effects.vortex = false")) << found.front();
}

TEST(EffectSwitches, ADragThatWindsActThroughIsNotSwitchedOffUnderThem)
{
    SimulationSettings settings = quiet_settings();
    settings.linear_drag = LinearDragSettings{1};
    settings.uniform_wind = UniformWindSettings{{1, 0, 0}};
    Simulation simulation(settings, ball(50, 1, 1, 3), {});
    const Problems refused = turn(simulation, "linear_drag", false);
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_NE(refused.front().find("effects.linear_drag = true"), std::string::npos) << refused.front();
    EXPECT_EQ(state_of(simulation, "linear_drag"), "active");
    ASSERT_EQ(turn(simulation, "uniform_wind", false), Problems{});
    EXPECT_EQ(turn(simulation, "linear_drag", false), Problems{});
}

} // namespace
} // namespace slod::test
