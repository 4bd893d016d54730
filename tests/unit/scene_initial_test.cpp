#include "scene_support.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <optional>
#include <set>

#include <Eigen/Geometry>

#include "scene/galaxy_pair.hpp"
#include "support/case_rows.hpp"
#include "support/gadget_records.hpp"

namespace slod::test {

namespace {

/// Sets an environment variable, or takes it away, for as long as it lives.
class Environment {
public:
    Environment(const char* name, const std::optional<std::string>& value) : name_(name)
    {
        if (const char* const old = std::getenv(name))
            old_ = old;
        set(value);
    }
    ~Environment() { set(old_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    void set(const std::optional<std::string>& value) const
    {
        value ? setenv(name_, value->c_str(), 1) : unsetenv(name_);
    }

    const char* name_;
    std::optional<std::string> old_;
};

/// A GADGET-2 file of one disc particle with the id 10, at x.
std::string one_particle(float x = 0)
{
    std::string header(256, '\0');
    header[8] = 1; // count of type 2
    const std::string vector(12, '\0');
    std::string place = vector;
    std::memcpy(place.data(), &x, sizeof x);
    return record(header) + record(place) + record(vector) + record(std::string("\n\0\0\0", 4)) +
           record(std::string(4, '\0'));
}

Scene gadget_scene(const std::string& file, InitialModel fallback = InitialModel::None)
{
    Scene scene;
    scene.simulation.kinds = {{"disc", 0.1}, {"bulge", 0.1}, {"halo", 0.1}};
    scene.initial = {.model = InitialModel::Gadget2, .file = file, .fallback = fallback};
    scene.galaxy = {.particles = 1000, .disc_share = 0.5, .bulge_share = 0.1};
    return scene;
}

Scene generated_scene(InitialModel model)
{
    Scene scene = gadget_scene("");
    scene.initial.model = model;
    return scene;
}

InitialParticles initial_of(const Scene& scene, const std::filesystem::path& input = {})
{
    auto result = load_initial(scene, input);
    if (const auto* const found = std::get_if<Problems>(&result))
        for (const std::string& problem : *found)
            ADD_FAILURE() << problem;
    return std::holds_alternative<Problems>(result) ? InitialParticles{} : std::get<InitialParticles>(result);
}

Problems refusal_of(const Scene& scene, const std::filesystem::path& input = {})
{
    const auto result = load_initial(scene, input);
    return std::holds_alternative<Problems>(result) ? std::get<Problems>(result) : Problems{};
}

TEST(LoadInitial, InputNamesTheFile)
{
    const ScratchFolder folder;
    const auto file = folder.write("mine", one_particle());
    const InitialParticles initial = initial_of(gadget_scene("other", InitialModel::Galaxy), file);
    ASSERT_EQ(initial.particles.size(), 1U);
    EXPECT_EQ(initial.particles[0].id, 10U);
    EXPECT_EQ(initial.source, "GADGET-2 file " + file.string() + ", 1 particles: 1 disc.");
}

TEST(LoadInitial, AFileThatInputNamesMustBeUsableWhateverTheFallback)
{
    const ScratchFolder folder;
    const Scene scene = gadget_scene("other", InitialModel::Galaxy);
    EXPECT_TRUE(only_says(refusal_of(scene, folder.path() / "none"), {"none: there is no such file"}));
    EXPECT_TRUE(only_says(refusal_of(scene, folder.write("bad", "rubbish")), {"bad: no GADGET-2 file"}));
}

TEST(LoadInitial, TheScenesFileIsInTheDataFolder)
{
    const ScratchFolder folder;
    const Environment data("SLOD_DATA_DIR", folder.path().string());
    const auto file = folder.write("mine", one_particle());
    EXPECT_EQ(initial_of(gadget_scene("mine")).source,
              "GADGET-2 file " + file.string() + ", 1 particles: 1 disc.");
}

TEST(LoadInitial, AnAbsoluteFileNeedsNoDataFolder)
{
    const ScratchFolder folder;
    const Environment data("SLOD_DATA_DIR", {});
    EXPECT_EQ(initial_of(gadget_scene(folder.write("mine", one_particle()).string())).particles.size(), 1U);
}

TEST(LoadInitial, AFileThatIsNotThereFallsBackAndSaysWhy)
{
    const ScratchFolder folder;
    {
        const Environment data("SLOD_DATA_DIR", folder.path().string());
        const InitialParticles initial = initial_of(gadget_scene("mine", InitialModel::Galaxy));
        EXPECT_EQ(initial.particles.size(), 1000U);
        EXPECT_EQ(initial.source,
                  "Generated galaxy with seed 1, 1000 particles: 500 disc, 100 bulge, 400 halo, because " +
                      (folder.path() / "mine").string() + " is not there.");
    }
    const Environment data("SLOD_DATA_DIR", {});
    EXPECT_NE(initial_of(gadget_scene("mine", InitialModel::GalaxyPair))
                  .source.find("because SLOD_DATA_DIR, the folder of mine, is not set."),
              std::string::npos);
    EXPECT_NE(
        initial_of(gadget_scene("", InitialModel::Galaxy)).source.find("because initial.file names no file."),
        std::string::npos);
}

TEST(LoadInitial, AFileThatIsThereButUnusableIsNoReasonToFallBack)
{
    const ScratchFolder folder;
    const Environment data("SLOD_DATA_DIR", folder.path().string());
    folder.write("mine", "rubbish");
    EXPECT_TRUE(
        only_says(refusal_of(gadget_scene("mine", InitialModel::Galaxy)), {"mine: no GADGET-2 file"}));
}

TEST(LoadInitial, N01_AParticleOutOfTheScenesRangeIsRefusedByName)
{
    const ScratchFolder folder;
    Scene scene = gadget_scene(folder.write("mine", one_particle(3e22F)).string());
    scene.simulation.gravity.emplace();
    const bool refused =
        only_says(refusal_of(scene), {"mine: particle 10 is out of the scene's range, 1e+21"});
    test::expect_within("refused beyond 1e22 softening lengths, of 1", refused ? 1 : 0, 1, 1);
    scene.simulation.gravity->precision = Precision::Double;
    EXPECT_EQ(initial_of(scene).particles.size(), 1U);
}

TEST(LoadInitial, WithoutAFallbackAFileThatIsNotThereIsRefusedWithTheRemedy)
{
    const Environment data("SLOD_DATA_DIR", {});
    EXPECT_TRUE(
        only_says(refusal_of(gadget_scene("mine")), {"initial.file = \"mine\": SLOD_DATA_DIR",
                                                     "name a file with --input or set SLOD_DATA_DIR"}));
}

TEST(LoadInitial, AModelThatReadsNoFileRefusesInput)
{
    EXPECT_TRUE(only_says(refusal_of(generated_scene(InitialModel::Galaxy), "mine"),
                          {"mine: the scene's initial.model is galaxy, which reads no file"}));
}

TEST(LoadInitial, NoneStartsWithNothing)
{
    const InitialParticles initial = initial_of(generated_scene(InitialModel::None));
    EXPECT_TRUE(initial.particles.empty());
    EXPECT_EQ(initial.source, "No particles at the start.");
}

TEST(LoadInitial, AGalaxyFollowsTheSeedAndTheKinds)
{
    Scene scene = generated_scene(InitialModel::Galaxy);
    const ParticleSet one = initial_of(scene).particles;
    const ParticleSet same = initial_of(scene).particles;
    scene.simulation.seed = 2;
    const ParticleSet other = initial_of(scene).particles;
    ASSERT_EQ(one.size(), 1000U);
    EXPECT_EQ(one[0].position, same[0].position);
    EXPECT_NE(one[0].position, other[0].position);
    EXPECT_EQ(one.front().kind, 0) << "disc";
    EXPECT_EQ(one.back().kind, 2) << "halo";
}

TEST(LoadInitial, APairIsTwoDifferentGalaxiesAtRestAsAWhole)
{
    const Scene scene = generated_scene(InitialModel::GalaxyPair);
    const ParticleSet pair = initial_of(scene).particles;
    ASSERT_EQ(pair.size(), 2000U);
    std::set<std::uint64_t> ids;
    double mass = 0, weighted_distance = 0, weighted_speed = 0;
    Vector3d centre(0, 0, 0), momentum(0, 0, 0);
    for (const Particle& particle : pair) {
        ids.insert(particle.id);
        const double m = double(particle.mass);
        mass += m;
        centre += m * particle.position;
        momentum += m * particle.velocity;
        weighted_distance += m * particle.position.norm();
        weighted_speed += m * particle.velocity.norm();
    }
    EXPECT_EQ(ids.size(), pair.size());
    // Every term of the sums is rounded a few times, and 2,000 of them are added: at most 2,000 times 2^-52
    // of the sum of their sizes.
    EXPECT_LT(centre.norm(), 2000 * 0x1p-52 * weighted_distance);
    EXPECT_LT(momentum.norm(), 2000 * 0x1p-52 * weighted_speed);
    // The galaxies differ: no particle sits in the second where its twin sits in the first.
    const Vector3d shift = pair[1000].position - pair[0].position;
    EXPECT_GT((pair[1001].position - pair[1].position - shift).norm(), 1e-3);
}

/// Two particles on the x axis about `centre`, moving along y, so that they turn about z.
ParticleSet pair_of_particles(const Vector3d& centre, const Vector3d& velocity, float mass)
{
    ParticleSet two(2);
    for (std::size_t n = 0; n < 2; ++n) {
        const double side = n == 0 ? 1 : -1;
        two[n].position = centre + Vector3d(0, side, 0);
        two[n].velocity = velocity + Vector3d(-side, 0, 0);
        two[n].mass = mass;
        two[n].id = 7 * n;
    }
    return two;
}

struct Encounter : testing::Test {
    const EncounterSettings settings{.separation = 20, .pericentre = 5, .inclination_deg = 30};
    const double constant = 3;
    const ParticleSet both =
        on_parabolic_orbit(pair_of_particles({5, 6, 7}, {1, 2, 3}, 2),
                           pair_of_particles({-9, 1, 0}, {0, 0, 4}, 1), settings, constant);

    Vector3d apart() const
    {
        return (both[2].position + both[3].position - both[0].position - both[1].position) / 2;
    }
    Vector3d approach() const
    {
        return (both[2].velocity + both[3].velocity - both[0].velocity - both[1].velocity) / 2;
    }

    // Positions and velocities up to 20 are shifted about ten times, each time rounded to 2^-52 of their
    // size.
    static constexpr double rounding = 20 * 10 * 0x1p-52;
};

TEST_F(Encounter, StartsAtTheSeparationAndApproaches)
{
    EXPECT_NEAR((apart() - Vector3d(20, 0, 0)).norm(), 0, rounding);
    EXPECT_LT(approach().x(), 0);
}

TEST_F(Encounter, IsParabolicWithThePericentre)
{
    // Point masses of 4 and 2: energy v^2/2 - G M / d = 0, angular momentum h^2 = 2 G M q along z. The
    // squares of v = 1.3 and h = 13 are as exact as twice those, times their size.
    const double mass = 6;
    EXPECT_NEAR(approach().squaredNorm() / 2, constant * mass / 20, 4 * rounding);
    const Vector3d momentum = apart().cross(approach());
    EXPECT_NEAR(momentum.norm(), std::sqrt(2 * constant * mass * 5), 40 * rounding);
    EXPECT_NEAR(momentum.z(), momentum.norm(), 40 * rounding);
}

TEST_F(Encounter, RestsAtTheOrigin)
{
    Vector3d centre(0, 0, 0), momentum(0, 0, 0);
    for (const Particle& particle : both) {
        centre += double(particle.mass) * particle.position;
        momentum += double(particle.mass) * particle.velocity;
    }
    EXPECT_NEAR(centre.norm(), 0, 6 * rounding); // of a mass of 6
    EXPECT_NEAR(momentum.norm(), 0, 6 * rounding);
}

TEST_F(Encounter, TiltsTheSecondAndNotTheFirst)
{
    const auto axis = [&](std::size_t first) {
        const Vector3d arm = both[first].position - both[first + 1].position;
        return Vector3d(arm.cross(both[first].velocity - both[first + 1].velocity).normalized());
    };
    const double angle = 30 * std::numbers::pi / 180;
    EXPECT_NEAR((axis(0) - Vector3d(0, 0, 1)).norm(), 0, rounding);
    EXPECT_NEAR((axis(2) - Vector3d(0, -std::sin(angle), std::cos(angle))).norm(), 0, rounding);
}

TEST_F(Encounter, GivesTheSecondIdsAfterTheFirsts)
{
    EXPECT_EQ(both[0].id, 0U);
    EXPECT_EQ(both[1].id, 7U);
    EXPECT_EQ(both[2].id, 8U);
    EXPECT_EQ(both[3].id, 15U);
}

TEST(ParabolicOrbit, AtItsPericentreHasNoRadialVelocity)
{
    const EncounterSettings settings{.separation = 5, .pericentre = 5, .inclination_deg = 0};
    const ParticleSet both = on_parabolic_orbit(pair_of_particles({0, 0, 0}, {0, 0, 0}, 1),
                                                pair_of_particles({0, 0, 0}, {0, 0, 0}, 1), settings, 1);
    const double approach =
        both[2].velocity.x() + both[3].velocity.x() - both[0].velocity.x() - both[1].velocity.x();
    EXPECT_NEAR(approach, 0, 20 * 0x1p-52); // four velocities of about 1, rounded a few times each
}

} // namespace

} // namespace slod::test
