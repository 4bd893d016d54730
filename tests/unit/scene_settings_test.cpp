#include "scene_support.hpp"

#include <cmath>

#include "scene/scene_check.hpp"
#include "support/case_rows.hpp"

namespace slod::test {

namespace {

/// A simulation without problems.
SimulationSettings sound()
{
    SimulationSettings settings;
    settings.kinds = {{"star", 0}, {"dust", 0}};
    settings.emitters.resize(2);
    settings.emitters[0].name = "a";
    settings.emitters[0].kind = "star";
    settings.emitters[1].name = "b";
    settings.emitters[1].kind = "dust";
    return settings;
}

TEST(SimulationSettings, ASoundSetHasNoProblems)
{
    EXPECT_TRUE(problems(sound()).empty()) << problems(sound()).front();
}

TEST(SimulationSettings, NeedAKind)
{
    SimulationSettings settings;
    EXPECT_TRUE(only_says(problems(settings), {"kind is missing: add a [[kind]]"}));
}

TEST(SimulationSettings, HaveAtMostAsManyKindsAsAByteCounts)
{
    SimulationSettings settings;
    for (int i = 0; i < 256; ++i)
        settings.kinds.push_back({"k" + std::to_string(i), 0});
    EXPECT_TRUE(problems(settings).empty());
    settings.kinds.push_back({"k256", 0});
    EXPECT_TRUE(only_says(problems(settings), {"kind appears 257 times", "at most 256"}));
}

TEST(SimulationSettings, RefuseNamesWithOtherLettersOrLengths)
{
    for (const std::string name :
         {"", "Star", "a b", "st\xc3\xa4r", "a.b", "123456789012345678901234567890123"}) {
        SimulationSettings settings = sound();
        settings.kinds.push_back({name, 0});
        EXPECT_TRUE(
            only_says(problems(settings), {"kind.2.name = \"" + name + "\" is no name; use 1 to 32"}));
    }
    for (const std::string name : {"a", "0", "_", "-", "12345678901234567890123456789012"}) {
        SimulationSettings settings = sound();
        settings.kinds.push_back({name, 0});
        EXPECT_TRUE(problems(settings).empty()) << name;
    }
    SimulationSettings settings = sound();
    settings.emitters[1].name = "B";
    EXPECT_TRUE(only_says(problems(settings), {"emitter.1.name = \"B\" is no name"}));
}

TEST(SimulationSettings, RefuseANameTwice)
{
    SimulationSettings settings = sound();
    settings.kinds.push_back({"star", 0});
    settings.emitters[1].name = "a";
    const Problems found = problems(settings);
    EXPECT_EQ(found.size(), 2U);
    EXPECT_TRUE(one_says(found, {"kind.2.name = \"star\" is the name of kind.0 too"}));
    EXPECT_TRUE(one_says(found, {"emitter.1.name = \"a\" is the name of emitter.0 too"}));
}

TEST(SimulationSettings, F25_RefuseADegenerateCollider)
{
    SimulationSettings settings = sound();
    settings.colliders = {{.name = "ball", .shape = ColliderShape::Sphere},
                          {.name = "floor", .normal = {0, 0, 0}}};
    EXPECT_TRUE(only_says(problems(settings), {"collider.1.normal = [0, 0, 0] has no direction"}));
    settings.colliders[1] = {.name = "ball"};
    EXPECT_TRUE(only_says(problems(settings), {"collider.1.name = \"ball\" is the name of collider.0 too"}));
    settings.colliders.resize(max_colliders + 1, {.name = "wall"});
    const Problems found = problems(settings);
    EXPECT_TRUE(one_says(found, {"collider appears 257 times; use at most 256."}));
    expect_at_least("problems named", double(found.size()), 1);
}

// Each shape with a key of another one, of which the default says nothing.
TEST(SimulationSettings, RefuseKeysThatACollidersShapeDoesNotHave)
{
    const auto says = [](const ColliderSettings& collider, const std::string& part) {
        SimulationSettings settings = sound();
        settings.colliders = {collider};
        return only_says(problems(settings), {"collider.0." + part});
    };
    using enum ColliderShape;
    EXPECT_TRUE(says({.name = "solid", .shape = Plane, .radius = 2},
                     "radius is no key of shape = \"plane\"; leave it out"));
    EXPECT_TRUE(
        says({.name = "solid", .shape = Plane, .file = "bowl.obj"}, "file is no key of shape = \"plane\""));
    EXPECT_TRUE(says({.name = "solid", .shape = Sphere, .half_extent = {1, 2, 1}}, "half_extent is no key"));
    EXPECT_TRUE(says({.name = "solid", .shape = Sphere, .normal = {0, 1, 0}}, "normal is no key"));
    EXPECT_TRUE(says({.name = "solid", .shape = Box, .axis = {0, 1, 0}}, "axis is no key"));
    EXPECT_TRUE(says({.name = "solid", .shape = Cone, .thickness = 2}, "thickness is no key"));
    EXPECT_TRUE(says({.name = "solid", .shape = Capsule, .scale = 2}, "scale is no key"));
    EXPECT_TRUE(
        says({.name = "solid", .shape = Mesh, .file = "bowl.obj", .spacing = 2}, "spacing is no key"));
    EXPECT_TRUE(
        says({.name = "solid", .shape = Heightfield, .radius = 2, .file = "hills.txt"}, "radius is no key"));
    EXPECT_TRUE(says({.name = "solid", .shape = DistanceGrid, .file = "ball.sdf", .spacing = 2},
                     "spacing is no key of shape = \"distance_grid\""));
    SimulationSettings settings = sound();
    settings.colliders = {{.name = "post", .shape = Capsule, .radius = 2, .axis = {0, 0, 3}},
                          {.name = "bowl", .shape = Mesh, .file = "bowl.obj", .scale = 2, .thickness = 0.1},
                          {.name = "ball",
                           .shape = DistanceGrid,
                           .rotation = {0, 0, 45},
                           .file = "ball.sdf",
                           .scale = 2,
                           .thickness = 0.1}};
    EXPECT_EQ(problems(settings), Problems{});
}

TEST(SimulationSettings, RefuseADegenerateSink)
{
    SimulationSettings settings = sound();
    settings.sinks = {{.name = "floor"}, {.name = "hole", .shape = SinkShape::Sphere}};
    EXPECT_TRUE(only_says(problems(settings), {"sink.1.radius = 0 leaves a sphere without an inside"}));
    settings.sinks[1] = {.name = "floor"};
    EXPECT_TRUE(only_says(problems(settings), {"sink.1.name = \"floor\" is the name of sink.0 too"}));
    settings.sinks.resize(max_sinks + 1, {.name = "more"});
    EXPECT_TRUE(one_says(problems(settings), {"sink appears 65 times; use at most 64."}));
}

TEST(SimulationSettings, RefuseMoreElementsOfAnEffectThanTheBound)
{
    SimulationSettings settings = sound();
    settings.fields.of<Attractor>().resize(max_fields);
    EXPECT_EQ(problems(settings), Problems{});
    settings.fields.of<Attractor>().resize(max_fields + 1);
    EXPECT_TRUE(only_says(problems(settings), {"attractor appears 257 times; use at most 256."}));
}

TEST(SimulationSettings, RefuseKeysThatAnEmittersShapeDoesNotHave)
{
    const auto says = [](EmitterSettings emitter, const std::string& start) {
        SimulationSettings settings = sound();
        emitter.name = "b";
        emitter.kind = "dust";
        settings.emitters[1] = emitter;
        return only_says(problems(settings), {"emitter.1." + start});
    };
    using enum EmitterShape;
    EXPECT_TRUE(says({.radius = 1}, "radius is no key of shape = \"point\"; leave it out"));
    EXPECT_TRUE(says({.fill = Fill::Surface}, "fill is no key of shape = \"point\""));
    EXPECT_TRUE(says({.shape = Disc, .radius = 1, .half_extent = {0, 1, 0}}, "half_extent is no key"));
    EXPECT_TRUE(says({.shape = Ring, .radius = 2, .inner_radius = 1}, "inner_radius is no key"));
    EXPECT_TRUE(says({.shape = Box, .radius = 1, .half_extent = {1, 1, 1}}, "radius is no key"));
    EXPECT_TRUE(says({.shape = Ring}, "radius = 0 is that of a point"));
    EXPECT_TRUE(says({.shape = Disc, .radius = 1, .inner_radius = 1}, "inner_radius = 1 leaves nothing"));
    EXPECT_TRUE(says({.shape = Sphere, .radius = 2, .inner_radius = 1, .fill = Fill::Surface},
                     "inner_radius is no key of a surface"));
    EXPECT_TRUE(says({.shape = Box}, "half_extent = [0, 0, 0] is that of a point"));
    EXPECT_TRUE(says({.shape = Box, .half_extent = {0, 1, 0}, .fill = Fill::Surface},
                     "half_extent leaves a box without a surface"));
}

TEST(SimulationSettings, RefuseWhatSaysNotHowManyAnEmitterThrowsOut)
{
    SimulationSettings settings = sound();
    settings.emitters[0].schedule = {{0, 5}, {1, 6}};
    EXPECT_TRUE(problems(settings).empty());
    settings.emitters[0].rate = 7;
    EXPECT_TRUE(only_says(problems(settings), {"emitter.0.rate = 7 is given beside a schedule"}));
    settings.emitters[0].rate = 0;
    settings.emitters[0].schedule[1] = {0, 6};
    EXPECT_TRUE(only_says(problems(settings), {"emitter.0.schedule has the time 0 after 0"}));
    settings.emitters[0].schedule.clear();
    settings.emitters[0].burst_period = 2;
    EXPECT_TRUE(only_says(problems(settings), {"emitter.0.burst_period = 2 is given without a burst"}));
    settings.emitters[0].burst = 3;
    EXPECT_TRUE(problems(settings).empty());
}

TEST(SimulationSettings, RefuseAnEmitterOfAnUnknownKind)
{
    SimulationSettings settings = sound();
    settings.emitters[1].kind = "water";
    EXPECT_TRUE(only_says(problems(settings),
                          {"emitter.1.kind = \"water\" is no kind of the scene; its kinds are star, dust."}));
}

TEST(SimulationSettings, RefuseADirectionOfLengthZeroAndTakeAnyOther)
{
    SimulationSettings settings = sound();
    settings.emitters[1].direction = {0, 0, 0};
    EXPECT_TRUE(only_says(problems(settings), {"emitter.1.direction = [0, 0, 0] is none; give the axis"}));
    for (const Vector3d& direction : {Vector3d(1e-200, 0, 0), Vector3d(0, 1e200, 0), Vector3d(0, 0, -1)}) {
        settings.emitters[1].direction = direction;
        EXPECT_TRUE(problems(settings).empty()) << direction;
    }
}

TEST(SimulationSettings, RefuseAnEmitterThatStopsBeforeItStarts)
{
    SimulationSettings settings = sound();
    settings.emitters[1].start = 5;
    for (const double stop : {1.0, 5.0}) {
        settings.emitters[1].stop = stop;
        EXPECT_TRUE(
            only_says(problems(settings), {"emitter.1.stop = " + std::to_string(int(stop)) + " is not after",
                                           "emitter.1.start = 5; use more than that"}));
    }
    settings.emitters[1].stop = std::nextafter(5, 6);
    EXPECT_TRUE(problems(settings).empty());
}

// 6.6743e-11 * 1e41 is 6.6743e30 in double too, and a tenth of it may be used.
TEST(SimulationSettings, RefuseUnitsInWhichNewtonsConstantIsBeyondSense)
{
    SimulationSettings settings = sound();
    settings.units = {.length_m = 1, .mass_kg = 1e41, .time_s = 1};
    EXPECT_TRUE(only_says(problems(settings), {"units.length = 1, units.mass = 1e+41 and units.time = 1 make",
                                               "at most 1e+30."}));
    settings.units.mass_kg = 1e40;
    EXPECT_TRUE(problems(settings).empty());
    for (const double mass : {0.0, -1.0, double(INFINITY), double(NAN)}) {
        settings.units.mass_kg = mass;
        EXPECT_EQ(problems(settings).size(), 1U) << mass;
    }
}

TEST(SimulationSettings, RefuseLivesThatAreNoPowersOfTwo)
{
    SimulationSettings settings = sound();
    settings.motion.shortest_life = 3;
    settings.motion.longest_life = 100;
    const Problems found = problems(settings);
    EXPECT_EQ(found.size(), 2U);
    EXPECT_TRUE(one_says(found, {"motion.shortest_life = 3 is no power of two; use 2."}));
    EXPECT_TRUE(one_says(found, {"motion.longest_life = 100 is no power of two; use 64."}));
}

TEST(SimulationSettings, RefuseRulesOfRigidMotionInAnyOther)
{
    SimulationSettings settings = sound();
    settings.motion.merged_velocities = MergedVelocities::Collapse;
    settings.motion.build_respects_limits = true;
    const Problems found = problems(settings);
    EXPECT_TRUE(one_says(found, {"motion.merged_velocities = \"collapse\"", "motion.kind = \"rigid\""}));
    EXPECT_TRUE(one_says(found, {"motion.build_respects_limits = true", "motion.kind = \"rigid\""}));
    settings.motion.motion = Motion::Rigid;
    EXPECT_TRUE(problems(settings).empty());
}

TEST(SimulationSettings, RefuseAShortestLifeLongerThanTheLongest)
{
    SimulationSettings settings = sound();
    settings.motion.shortest_life = 128;
    EXPECT_TRUE(only_says(problems(settings),
                          {"motion.shortest_life = 128 is longer than motion.longest_life = 64"}));
    settings.motion.longest_life = 128;
    EXPECT_TRUE(problems(settings).empty()) << "equal lives are one fixed life";
}

TEST(SimulationSettings, RefuseWindWithoutDrag)
{
    SimulationSettings settings = sound();
    settings.uniform_wind.emplace();
    EXPECT_TRUE(
        only_says(problems(settings), {"uniform_wind acts through the air's drag", "add [linear_drag]"}));
    settings.linear_drag.emplace();
    EXPECT_TRUE(problems(settings).empty());
}

TEST(SimulationSettings, RefuseEveryWindWithoutDrag)
{
    SimulationSettings settings = sound();
    settings.fields.of<Turbulence>().emplace();
    EXPECT_TRUE(
        only_says(problems(settings), {"turbulence acts through the air's drag", "[quadratic_drag]"}));
    settings.quadratic_drag.emplace();
    EXPECT_TRUE(problems(settings).empty());
}

TEST(SimulationSettings, RefuseWindThroughADragOfNoStrength)
{
    SimulationSettings settings = sound();
    settings.fields.of<Turbulence>().emplace();
    settings.linear_drag = LinearDragSettings{0};
    EXPECT_TRUE(only_says(problems(settings), {"turbulence acts through", "linear_drag.rate = 0; use more"}));
    settings.quadratic_drag = QuadraticDragSettings{0};
    EXPECT_TRUE(only_says(problems(settings), {"linear_drag.rate = 0 and quadratic_drag.coefficient = 0"}));
    settings.linear_drag.reset();
    EXPECT_TRUE(only_says(problems(settings), {"quadratic_drag.coefficient = 0; use more than 0"}));
    settings.linear_drag = LinearDragSettings{1e-3};
    EXPECT_TRUE(problems(settings).empty()) << "one of them is enough";
}

TEST(SimulationSettings, RefuseEffectsOfPlaceByTheirKeys)
{
    SimulationSettings settings = sound();
    settings.fields.of<Spring>() = {{}, {.stiffness = 1e9}};
    EXPECT_TRUE(only_says(problems(settings), {"spring.1.stiffness = ", "use less than"}));
    settings.fields.of<Spring>().pop_back();
    EXPECT_TRUE(problems(settings).empty());
    settings.linear_drag.emplace();
    settings.fields.of<Turbulence>() = TurbulenceSettings{.length = 0};
    EXPECT_TRUE(only_says(problems(settings), {"turbulence.length = 0", "use more than 0"}));
}

// A frame of 1/4 follows springs of less than 64.
TEST(SimulationSettings, RefuseSpringsThatAreTooStiffTogether)
{
    SimulationSettings settings = sound();
    settings.time.step = 0.25;
    settings.fields.of<Spring>() = {{.stiffness = 30}, {.stiffness = 0}, {.stiffness = 33}};
    EXPECT_TRUE(problems(settings).empty());
    settings.fields.of<Spring>()[1].stiffness = 1;
    EXPECT_TRUE(only_says(problems(settings), {"the sum of spring.0.stiffness to spring.2.stiffness, 64,",
                                               "use less than 64, or a shorter time.step"}));
    settings.fields.of<Spring>()[1].stiffness = 64;
    EXPECT_TRUE(only_says(problems(settings), {"spring.1.stiffness = 64 is more than"}));
}

} // namespace

} // namespace slod::test
