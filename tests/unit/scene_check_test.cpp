#include "scene_support.hpp"

#include <algorithm>

#include "scene/scene_check.hpp"
#include "simd/kernels.hpp"

namespace slod::test {

namespace {

/// A scene that starts from `model` without problems.
Scene starting_with(InitialModel model)
{
    Scene scene;
    scene.simulation.kinds = {{"disc", 0}, {"bulge", 0}, {"halo", 0}};
    scene.initial.model = model;
    scene.galaxy = {.particles = 1000, .disc_share = 0.5, .bulge_share = 0.1};
    scene.galaxy.bulge_mass = 1;
    scene.galaxy.halo_mass = 42;
    return scene;
}

TEST(SceneCheck, IncludesTheSimulations)
{
    Scene scene = starting_with(InitialModel::Galaxy);
    scene.simulation.motion.longest_life = 3;
    EXPECT_TRUE(one_says(problems(scene), {"motion.longest_life = 3 is no power of two"}));
}

TEST(SceneCheck, AStartWithoutParticlesNeedsAFiniteBreadth)
{
    Scene scene = starting_with(InitialModel::None);
    EXPECT_TRUE(only_says(problems(scene), {"background.max_breadth = inf", "set it to a length"}));
    scene.simulation.background.max_breadth = 2;
    EXPECT_TRUE(problems(scene).empty());
    EXPECT_TRUE(problems(starting_with(InitialModel::Galaxy)).empty());
}

TEST(SceneCheck, AGalaxyNeedsAKindForEachComponentThatHasMass)
{
    Scene scene = starting_with(InitialModel::Galaxy);
    scene.simulation.kinds = {{"disc", 0}, {"halo", 0}};
    EXPECT_TRUE(only_says(problems(scene), {"galaxy.bulge_mass = 1.0 needs a kind", "name = \"bulge\""}));
    scene.galaxy.bulge_mass = 0;
    EXPECT_TRUE(problems(scene).empty());
}

TEST(SceneCheck, AGalaxysMassNeedsParticlesToCarryIt)
{
    Scene scene = starting_with(InitialModel::Galaxy);
    scene.galaxy.bulge_share = 0;
    EXPECT_TRUE(only_says(problems(scene), {"galaxy.bulge_mass = 1.0 has no particle to carry it"}));
    scene.galaxy.bulge_share = 0.6;
    EXPECT_TRUE(only_says(problems(scene), {"galaxy.halo_mass = 42.0 has no particle to carry it"}))
        << "disc and bulge together have more than all particles";
    scene.galaxy.bulge_share = 0.5;
    scene.galaxy.halo_mass = 0;
    EXPECT_TRUE(problems(scene).empty());
}

TEST(SceneCheck, AGalaxyThatIsNotGeneratedIsNotChecked)
{
    Scene scene = starting_with(InitialModel::Gadget2);
    scene.simulation.kinds = {{"star", 0}};
    EXPECT_TRUE(problems(scene).empty());
    scene.initial.fallback = InitialModel::Galaxy;
    EXPECT_EQ(problems(scene).size(), 3U) << "its fallback is";
}

TEST(SceneCheck, AnEncounterStartsApartAndFartherThanItsPericentre)
{
    Scene scene = starting_with(InitialModel::GalaxyPair);
    EXPECT_TRUE(problems(scene).empty());
    scene.encounter = {.separation = 5, .pericentre = 8};
    EXPECT_TRUE(
        only_says(problems(scene), {"encounter.pericentre = 8.0 is larger than encounter.separation = 5.0"}));
    scene.encounter = {.separation = 0, .pericentre = 0};
    EXPECT_TRUE(only_says(problems(scene), {"encounter.separation = 0.0"}));
}

// The names that are left are those of the kernels that run here, whichever processor this is.
TEST(SceneCheck, AnInstructionSetThatDoesNotRunHereIsRefusedWithThoseThatDo)
{
    Scene scene = starting_with(InitialModel::Galaxy);
    std::string runnable = "auto";
    for (const simd::KernelTable* table : simd::runnable_kernels())
        runnable += ", " + std::string(table->name);
    for (std::size_t row = 0; row < names(InstructionSet{}).size(); ++row) {
        scene.loop.server.isa = InstructionSet(row);
        const std::string name(names(InstructionSet{})[row]);
        if (simd::kernels(name) != nullptr)
            EXPECT_TRUE(problems(scene).empty()) << name;
        else
            EXPECT_TRUE(only_says(problems(scene), {"server.isa = \"" + name + "\" does not run",
                                                    "use one of " + runnable + "."}));
    }
}

TEST(SceneCheck, EveryKernelHasItsInstructionSetAmongTheSettings)
{
    const auto all = names(InstructionSet{});
    for (const simd::KernelTable* table : simd::runnable_kernels())
        EXPECT_NE(std::find(all.begin(), all.end(), table->name), all.end()) << table->name;
}

TEST(SceneCheck, AFileIsNoFallbackForAFile)
{
    Scene scene = starting_with(InitialModel::Gadget2);
    scene.initial.fallback = InitialModel::Gadget2;
    EXPECT_TRUE(
        only_says(problems(scene), {"initial.fallback = \"gadget2\"", "use none, galaxy or galaxy_pair"}));
}

} // namespace

} // namespace slod::test
