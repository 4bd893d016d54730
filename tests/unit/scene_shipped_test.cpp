#include "scene_contents.hpp"
#include "scene_support.hpp"

#include <fstream>
#include <iterator>
#include <map>

// The scenes in config/scenes.
namespace slod::test {

namespace {

class ShippedScene : public testing::TestWithParam<std::string> {
protected:
    static std::filesystem::path file(const std::string& name)
    {
        return std::filesystem::path(SLOD_SCENES) / (name + ".toml");
    }
    static Scene read(const std::filesystem::path& file, const std::vector<std::string>& overrides = {})
    {
        const auto loaded = load_scene(file, overrides);
        if (const auto* const found = std::get_if<Problems>(&loaded))
            for (const std::string& problem : *found)
                ADD_FAILURE() << problem;
        return std::holds_alternative<Scene>(loaded) ? std::get<Scene>(loaded) : Scene{};
    }
};

TEST_P(ShippedScene, HasNoProblems)
{
    EXPECT_FALSE(read(file(GetParam())).title.empty());
}

TEST_P(ShippedScene, ComesBackFromItsOwnText)
{
    const Scene scene = read(file(GetParam()));
    const auto again = load_scene({.name = "again", .text = to_toml(scene), .folder = SLOD_SCENES}, {});
    ASSERT_TRUE(std::holds_alternative<Scene>(again)) << std::get<Problems>(again).front();
    EXPECT_EQ(contents(std::get<Scene>(again)), contents(scene));
}

TEST_P(ShippedScene, ExplainsEveryKey)
{
    // By a comment in its line. Of tables alike, one is enough; a title speaks for itself.
    std::ifstream stream(file(GetParam()));
    std::map<std::string, bool> explained;
    std::string table;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with('['))
            table = line.substr(0, line.rfind(']') + 1);
        if (const auto equals = line.find(" = "); equals != std::string::npos && line[0] != '#')
            explained[table + " " + line.substr(0, equals)] |= line.find('#') != std::string::npos;
    }
    EXPECT_GT(explained.size(), 10U);
    for (const auto& [key, has_comment] : explained)
        EXPECT_TRUE(has_comment || key == " title") << key;
}

/// The first block of TOML in README.md.
std::string readme_scene()
{
    const std::string readme = file_content(README);
    const std::string begin = "```toml\n";
    const std::size_t first = readme.find(begin);
    if (first == std::string::npos)
        return {};
    return readme.substr(first + begin.size(), readme.find("```\n", first + 1) - first - begin.size());
}

TEST(ReadmeScene, IsSoundAndThrowsOutParticles)
{
    const Scene scene = scene_of(readme_scene());
    EXPECT_EQ(scene.simulation.emitters.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<InitialParticles>(load_initial(scene, {})));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene,
                         testing::Values("bowl", "cones", "fountain", "galaxy", "galaxy-collision",
                                         "moving-roi", "paper-fountain", "turbulence"));

TEST_F(ShippedScene, OfTheCollisionHasTheFilesUnits)
{
    // GADGET's own constant for this file; it gives six digits.
    const Scene scene = read(file("galaxy-collision"));
    EXPECT_NEAR(scene.simulation.units.gravitational_constant(), 43007.1, 0.05);
    EXPECT_EQ(scene.simulation.kinds.at(0).name, "halo");
    EXPECT_EQ(scene.simulation.kinds.at(0).softening, 1.0);
    EXPECT_EQ(scene.simulation.kinds.at(1).name, "disc");
    EXPECT_EQ(scene.simulation.kinds.at(1).softening, 0.4);
    EXPECT_EQ(scene.simulation.time.step, 0.001);
}

TEST_F(ShippedScene, OfTheGalaxyTakesAMillionStars)
{
    EXPECT_EQ(read(file("galaxy")).galaxy.particles, 10'000U);
    EXPECT_EQ(read(file("galaxy"), {"galaxy.particles=1000000"}).galaxy.particles, 1'000'000U);
}

TEST_F(ShippedScene, OfTheFountainHasThreeStreamsOfTwoThousandDropletsFiveSecondsApart)
{
    const Scene scene = read(file("fountain"));
    ASSERT_EQ(scene.simulation.emitters.size(), 3U);
    double start = 0;
    for (const EmitterSettings& emitter : scene.simulation.emitters) {
        EXPECT_EQ(emitter.rate * emitter.lifetime, 2000);
        EXPECT_EQ(emitter.start, start);
        start += 5;
    }
    EXPECT_TRUE(scene.simulation.uniform_gravity && scene.simulation.linear_drag &&
                scene.simulation.uniform_wind);
    EXPECT_FALSE(scene.simulation.gravity);
}

TEST_F(ShippedScene, OfTheFountainTakesTenMillionDropletsAsItSaysItself)
{
    // The overrides are read from the file's own comment.
    std::ifstream stream(file("fountain"));
    std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::string mark = "--set emitter";
    std::vector<std::string> overrides;
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
        const auto begin = at + 6;
        overrides.push_back(text.substr(begin, text.find_first_of(" \n", begin) - begin));
    }
    ASSERT_EQ(overrides.size(), 3U);
    double droplets = 0;
    for (const EmitterSettings& emitter : read(file("fountain"), overrides).simulation.emitters)
        droplets += emitter.rate * emitter.lifetime;
    EXPECT_NEAR(droplets, 10e6, 10); // rates are given in whole droplets a second, three times 2.5 s
}

} // namespace

} // namespace slod::test
