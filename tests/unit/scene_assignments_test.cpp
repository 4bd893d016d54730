#include "scene_support.hpp"

#include <limits>
#include <vector>

#include "scene/assignments.hpp"

namespace slod::test {

namespace {

using Assignments = std::vector<Assignment>;

constexpr double infinity = std::numeric_limits<double>::infinity();

RegionOfInterest small_box()
{
    RegionOfInterest region;
    region.name = "box";
    region.shape = Shape::Box;
    return region;
}

TEST(SceneAssignments, GiveFieldsOfARegionTheirValues)
{
    RegionOfInterest region = small_box();
    const Assignments wanted{{"centre", "[1, 2.5, -3]"}, {"shape", "\"sphere\""}, {"radius", "4"},
                             {"precedence", "-7"},       {"far", "inf"},          {"max_cluster_size", "8"},
                             {"bin_by", "speed"},        {"follows", "desk 1"}};
    EXPECT_EQ(assign_fields(region, wanted), Problems{});
    EXPECT_EQ(region.centre, Vector3d(1, 2.5, -3));
    EXPECT_EQ(region.shape, Shape::Sphere);
    EXPECT_EQ(region.radius, 4);
    EXPECT_EQ(region.precedence, -7);
    EXPECT_EQ(region.far_distance, infinity);
    EXPECT_EQ(region.partition.max_cluster_size, 8);
    EXPECT_EQ(region.partition.bin_by, BinBy::Speed);
    EXPECT_EQ(region.follows, "desk 1");
}

TEST(SceneAssignments, TheLastOfAKeyHolds)
{
    RegionOfInterest region = small_box();
    EXPECT_EQ(assign_fields(region, Assignments{{"radius", "4"}, {"radius", "5"}}), Problems{});
    EXPECT_EQ(region.radius, 5);
}

// Each is wrong in its own way, and comes after one that is right.
TEST(SceneAssignments, NothingChangesUnlessAllAreRight)
{
    const std::vector<std::pair<Assignment, std::string>> wrong{
        {{"centre", "[1, 2]"}, "three numbers"},
        {{"centre", "[1, 2, nan]"}, "out of range"},
        {{"half_extent", "[1, 1, -1]"}, "out of range"},
        {{"max_cluster_size", "0"}, "use 1 to 1000000"},
        {{"shape", "\"blob\""}, "everywhere, box, sphere, frustum"},
        {{"lunch", "1"}, "is no key here"},
        {{"far", "[1"}, "is not TOML"},
        {{"radius", "1\nshape = 2"}, "is no number"}};
    for (const auto& [assignment, says] : wrong) {
        SCOPED_TRACE(assignment.key + " = " + assignment.value);
        RegionOfInterest region = small_box();
        const Problems found = assign_fields(region, Assignments{{"radius", "4"}, assignment});
        EXPECT_TRUE(only_says(found, {assignment.key, says}));
        EXPECT_EQ(region, small_box());
    }
}

TEST(SceneAssignments, TheFirstEightProblemsAreTold)
{
    Assignments wanted;
    for (int i = 0; i < 20; ++i)
        wanted.push_back({"lunch" + std::to_string(i), "1"});
    RegionOfInterest region = small_box();
    const Problems found = assign_fields(region, wanted);
    ASSERT_EQ(found.size(), 8U);
    EXPECT_TRUE(found.back().starts_with("lunch7 ")) << found.back();
    SimulationSettings settings;
    EXPECT_EQ(assign_fields(settings, wanted).size(), 8U);
}

TEST(SceneAssignments, TheFieldsOfARegionMakeTheSameRegion)
{
    RegionOfInterest region = small_box();
    region.centre = {0.1, -1e30, 1.0 / 3};
    region.precedence = -1'000'000'000;
    region.follows = "a \"b\" = [c]\\";
    region.least_speed = 1e-300;
    region.partition.max_breadth = infinity;
    RegionOfInterest copy;
    EXPECT_EQ(assign_fields(copy, fields_of(region)), Problems{});
    EXPECT_EQ(copy, region);
}

TEST(SceneAssignments, ReachASettingByTableAndKey)
{
    SimulationSettings settings;
    settings.gravity.emplace();
    const Assignments wanted{{"gravity.strength", "0.5"}, {"uniform_wind.velocity", "[1, 2, 3]"}};
    EXPECT_EQ(assign_fields(settings, wanted), Problems{});
    EXPECT_EQ(settings.gravity->strength, 0.5);
    ASSERT_TRUE(settings.uniform_wind);
    EXPECT_EQ(settings.uniform_wind->velocity, Vector3d(1, 2, 3));
}

TEST(SceneAssignments, ReachTheTablesOfAnArrayByNumberAndAddOne)
{
    SimulationSettings settings;
    const Assignments wanted{{"attractor.0.strength", "0.5"},
                             {"attractor.1.position", "[1, 2, 3]"},
                             {"attractor.0.softening", "0.25"}};
    EXPECT_EQ(assign_fields(settings, wanted), Problems{});
    const std::vector<AttractorSettings> expected{{.strength = 0.5, .softening = 0.25},
                                                  {.position = {1, 2, 3}}};
    EXPECT_EQ(settings.fields.of<Attractor>(), expected);
    EXPECT_TRUE(only_says(assign_fields(settings, Assignments{{"attractor.3.strength", "1"}}),
                          {"attractor.3.strength", "has 2 of", "number 2 adds one"}));
}

TEST(SceneAssignments, SayWhichSettingIsNone)
{
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"gravity", "table.key"},
        {"gravity.lunch", "strength"},
        {"gravitx.strength", "gravity"},
        {"server.threads", "no table of the simulation"},
        {"emitter.rate", "write emitter.0.rate"},
        {"attractor.x.strength", "write attractor.0.strength"},
        {"attractor.0", "write attractor.0.KEY"},
        {"attractor.1.strength", "the scene has 0 of [[attractor]], counted from 0; number 0 adds one"},
        {"attractor.0.lunch", "strength"}};
    for (const auto& [key, says] : wrong) {
        SimulationSettings settings;
        EXPECT_TRUE(only_says(assign_fields(settings, Assignments{{key, "1"}}), {key, says})) << key;
        EXPECT_FALSE(settings.gravity);
    }
}

} // namespace
} // namespace slod::test
