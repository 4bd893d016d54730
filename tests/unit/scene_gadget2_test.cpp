#include "scene_support.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sys/stat.h>
#include <utility>

#include "scene/gadget2.hpp"
#include "support/case_rows.hpp"
#include "support/gadget_records.hpp"

namespace slod::test {

namespace {

const std::vector<ParticleKind> all_kinds = {{"halo", 1},  {"disc", 1},  {"gas", 1},
                                             {"bulge", 1}, {"stars", 1}, {"bndry", 1}};

/// What a test writes into a file. Particle n has position n + {0, 0.25, 0.5}, velocity -position and id 10 +
/// n.
struct GadgetFile {
    std::array<std::int32_t, 6> counts{};
    std::array<double, 6> masses{};
    std::int32_t file_count = 1;
    std::vector<float> positions, velocities, own_masses;
    std::vector<std::uint32_t> ids;

    GadgetFile(const std::array<std::int32_t, 6>& of_types, const std::array<double, 6>& mass_of_types)
        : counts(of_types), masses(mass_of_types)
    {
        std::uint32_t n = 0;
        for (std::size_t type = 0; type < 6; ++type)
            for (std::int32_t i = 0; i < counts[type]; ++i, ++n) {
                for (const float shift : {0.0F, 0.25F, 0.5F}) {
                    positions.push_back(float(n) + shift);
                    velocities.push_back(-float(n) - shift);
                }
                ids.push_back(10 + n);
                if (masses[type] == 0)
                    own_masses.push_back(100 + float(n));
            }
    }

    std::string header() const
    {
        std::string header(256, '\0');
        std::memcpy(header.data(), counts.data(), sizeof counts);
        std::memcpy(header.data() + 24, masses.data(), sizeof masses);
        std::memcpy(header.data() + 124, &file_count, sizeof file_count);
        return header;
    }

    std::string bytes() const
    {
        std::string all = record(header()) + record(bytes_of(positions)) + record(bytes_of(velocities)) +
                          record(bytes_of(ids));
        if (!own_masses.empty())
            all += record(bytes_of(own_masses));
        return all;
    }
};

/// Where the blocks of a file of `count` particles start.
std::size_t pos_block()
{
    return 8 + 256;
}
std::size_t vel_block(std::size_t count)
{
    return pos_block() + 8 + 12 * count;
}
std::size_t id_block(std::size_t count)
{
    return vel_block(count) + 8 + 12 * count;
}

GadgetFile halo_and_disc()
{
    return {{0, 3, 2, 0, 0, 0}, {0, 2.5, 0.5, 0, 0, 0}};
}

std::variant<ParticleSet, Problems> read(const std::string& bytes,
                                         const std::vector<ParticleKind>& kinds = all_kinds)
{
    const ScratchFolder folder;
    return read_gadget2(folder.write("g.gadget2", bytes), kinds);
}

ParticleSet particles_of(const std::string& bytes)
{
    const auto result = read(bytes);
    if (const auto* const found = std::get_if<Problems>(&result))
        for (const std::string& problem : *found)
            ADD_FAILURE() << problem;
    return std::holds_alternative<ParticleSet>(result) ? std::get<ParticleSet>(result) : ParticleSet{};
}

Problems problems_of_bytes(const std::string& bytes, const std::vector<ParticleKind>& kinds = all_kinds)
{
    const auto result = read(bytes, kinds);
    const auto* const found = std::get_if<Problems>(&result);
    return found != nullptr ? *found : Problems{};
}

TEST(Gadget2, ReadsPositionsVelocitiesIdsKindsAndMassesOfTheHeader)
{
    const ParticleSet particles = particles_of(halo_and_disc().bytes());
    ASSERT_EQ(particles.size(), 5U);
    for (std::size_t n = 0; n < 5; ++n) {
        EXPECT_EQ(particles[n].position, Vector3d(double(n), double(n) + 0.25, double(n) + 0.5));
        EXPECT_EQ(particles[n].velocity, -particles[n].position);
        EXPECT_EQ(particles[n].id, 10 + n);
        EXPECT_EQ(particles[n].mass, n < 3 ? 2.5F : 0.5F);
        EXPECT_EQ(particles[n].kind, n < 3 ? 0 : 1) << "the scene's row, not GADGET's type";
        EXPECT_EQ(particles[n].expiry_frame, Particle::never);
    }
}

TEST(Gadget2, ReadsMassesOfTheirOwnWhereTheHeaderHasNone)
{
    // Halo and stars have their own masses, the disc's is in the header.
    const GadgetFile file({0, 2, 1, 0, 2, 0}, {0, 0, 7, 0, 0, 0});
    const ParticleSet particles = particles_of(file.bytes());
    ASSERT_EQ(particles.size(), 5U);
    const std::array<float, 5> expected{100, 101, 7, 103, 104};
    for (std::size_t n = 0; n < 5; ++n)
        EXPECT_EQ(particles[n].mass, expected[n]);
}

TEST(Gadget2, ReadsAFileOfOneParticle)
{
    EXPECT_EQ(particles_of(GadgetFile({0, 1, 0, 0, 0, 0}, {0, 3, 0, 0, 0, 0}).bytes()).size(), 1U);
    EXPECT_EQ(particles_of(GadgetFile({0, 0, 0, 0, 0, 1}, {}).bytes()).at(0).mass, 100.0F);
}

TEST(Gadget2, NamesAllSixTypes)
{
    const ParticleSet particles = particles_of(GadgetFile({1, 1, 1, 1, 1, 1}, {}).bytes());
    ASSERT_EQ(particles.size(), 6U);
    const std::array<std::string_view, 6> expected{"gas", "halo", "disc", "bulge", "stars", "bndry"};
    for (std::size_t type = 0; type < 6; ++type)
        EXPECT_EQ(all_kinds[particles[type].kind].name, expected[type]);
}

TEST(Gadget2, ReadsIdsOf64Bits)
{
    const GadgetFile file = halo_and_disc();
    const std::vector<std::uint64_t> ids = {1ULL << 40, 2, 3, 4, 5};
    const std::string bytes = file.bytes().substr(0, id_block(5)) + record(bytes_of(ids));
    EXPECT_EQ(particles_of(bytes).at(0).id, 1ULL << 40);
}

TEST(Gadget2, LeavesBlocksAfterTheMassesAlone)
{
    EXPECT_EQ(particles_of(halo_and_disc().bytes() + record("potentials")).size(), 5U);
}

TEST(Gadget2, AFileWithoutParticlesIsRefused)
{
    EXPECT_TRUE(
        only_says(problems_of_bytes(GadgetFile({}, {}).bytes()), {"g.gadget2: ", "holds no particles"}));
}

TEST(Gadget2, AMissingFileAndAFolderAreNamed)
{
    const ScratchFolder folder;
    const auto say = [](const std::filesystem::path& file) {
        return std::get<Problems>(read_gadget2(file, all_kinds));
    };
    EXPECT_TRUE(only_says(say(folder.path() / "none"),
                          {(folder.path() / "none").string() + ": there is no such file"}));
    EXPECT_TRUE(only_says(say(folder.path()), {folder.path().string() + ": this is a folder"}));
    EXPECT_TRUE(only_says(say("/dev/null"), {"/dev/null: this is a pipe or a device"})) << "it has no size";
}

TEST(Gadget2, ATruncatedFileSaysInWhichBlockAndWhatIsMissing)
{
    const std::string whole = GadgetFile({0, 0, 5, 0, 0, 0}, {}).bytes();
    const std::size_t mass_block = id_block(5) + 8 + 20;
    const auto cut = [&](std::size_t size) { return problems_of_bytes(whole.substr(0, size)); };
    EXPECT_TRUE(only_says(cut(0), {"truncated before the header block: 264 bytes expected, 0 found"}));
    EXPECT_TRUE(only_says(cut(100), {"truncated in the header block: 264 bytes expected, 100 found"}));
    EXPECT_TRUE(only_says(cut(pos_block()), {"truncated before the POS block: 68 bytes expected, 0 found"}));
    EXPECT_TRUE(
        only_says(cut(pos_block() + 67), {"truncated in the POS block: 68 bytes expected, 67 found"}));
    EXPECT_TRUE(
        only_says(cut(vel_block(5) + 3), {"truncated before the VEL block: 68 bytes expected, 3 found"}));
    EXPECT_TRUE(only_says(cut(id_block(5) + 4), {"truncated in the ID block: 28 bytes expected, 4 found"}));
    EXPECT_TRUE(only_says(cut(mass_block), {"truncated before the MASS block: 28 bytes expected, 0 found"}));
    EXPECT_TRUE(
        only_says(cut(whole.size() - 1), {"truncated in the MASS block: 28 bytes expected, 27 found"}));
    EXPECT_TRUE(cut(whole.size()).empty());
}

TEST(Gadget2, N22_NoTruncationIsTakenForAFile)
{
    const std::string whole = GadgetFile({1, 0, 2, 0, 0, 0}, {}).bytes();
    std::size_t taken = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::size_t found = problems_of_bytes(whole.substr(0, size)).size();
        EXPECT_EQ(found, 1U) << size;
        taken += found == 0 ? 1 : 0;
    }
    expect_at_most("truncations taken for a file", double(taken), 0);
}

TEST(Gadget2, ABigEndianFileIsRecognised)
{
    std::string bytes = halo_and_disc().bytes();
    std::reverse(bytes.begin(), bytes.begin() + 4);
    EXPECT_TRUE(only_says(problems_of_bytes(bytes),
                          {"big-endian: its first record marker reads 65536, which is 256"}));
}

TEST(Gadget2, SnapFormats2And3AreRecognised)
{
    const std::string label = record("HEAD" + bytes_of<std::uint32_t>({264}));
    EXPECT_TRUE(only_says(problems_of_bytes(label + halo_and_disc().bytes()),
                          {"SnapFormat 2", "write it in SnapFormat 1"}));
    EXPECT_TRUE(only_says(problems_of_bytes("\x89HDF\r\n\x1a\n"),
                          {"SnapFormat 3, HDF5", "write it in SnapFormat 1"}));
    std::string swapped = label;
    std::reverse(swapped.begin(), swapped.begin() + 4);
    EXPECT_TRUE(only_says(problems_of_bytes(swapped), {"big-endian"}));
}

// Nobody writes into the pipe: opened, it would be waited on for ever.
TEST(Gadget2, APipeOrADeviceIsRefusedUnopened)
{
    const ScratchFolder folder;
    const std::filesystem::path pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const std::filesystem::path& file : {pipe, std::filesystem::path("/dev/zero")}) {
        const auto read = read_gadget2(file, all_kinds);
        ASSERT_TRUE(std::holds_alternative<Problems>(read));
        EXPECT_TRUE(only_says(std::get<Problems>(read), {file.string() + ": this is a pipe or a device"}));
    }
}

TEST(Gadget2, AnythingElseIsNoGadgetFile)
{
    EXPECT_TRUE(only_says(problems_of_bytes("title = \"a scene\"\n"), {"no GADGET-2 file in SnapFormat 1"}));
}

TEST(Gadget2, RecordMarkersThatDisagreeAreRefused)
{
    std::string bytes = halo_and_disc().bytes();
    bytes[vel_block(5) - 4] = 59; // the marker that closes POS, 60 bytes
    EXPECT_TRUE(only_says(problems_of_bytes(bytes),
                          {"markers around the POS block disagree, 60 before and 59 after"}));
}

TEST(Gadget2, ABlockOfAnotherLengthIsRefused)
{
    const GadgetFile file = halo_and_disc();
    const std::string doubles = record(bytes_of(std::vector<double>(15)));
    EXPECT_TRUE(
        only_says(problems_of_bytes(record(file.header()) + doubles),
                  {"the POS block is said to have 120 bytes where 60 are expected", "single precision"}));
}

TEST(Gadget2, N01_ValuesThatAreNotFiniteAreRefusedWithTheParticlesId)
{
    std::size_t tried = 0, taken = 0;
    const auto try_each = [&](std::vector<float> GadgetFile::*column) {
        for (const float bad :
             {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
              -std::numeric_limits<float>::infinity()}) {
            GadgetFile broken({0, 0, 2, 0, 0, 0}, {});
            for (std::size_t i = 0; i < (broken.*column).size(); ++i, ++tried) {
                GadgetFile one = broken;
                (one.*column)[i] = bad;
                const Problems found = problems_of_bytes(one.bytes()); // -inf is also a negative mass
                taken += !found.empty() && found.front().find("g.gadget2: particle 1") != std::string::npos
                             ? 0
                             : 1;
            }
        }
    };
    try_each(&GadgetFile::positions);
    try_each(&GadgetFile::velocities);
    try_each(&GadgetFile::own_masses);
    expect_within("values tried", double(tried), 3 * 14, 3 * 14);
    expect_at_most("values taken that are no numbers", double(taken), 0);
    GadgetFile file({0, 0, 5, 0, 0, 0}, {});
    file.positions[3] = std::numeric_limits<float>::quiet_NaN();
    file.velocities[6] = std::numeric_limits<float>::infinity();
    file.velocities[14] = std::numeric_limits<float>::infinity();
    file.own_masses[0] = std::numeric_limits<float>::infinity();
    const Problems found = problems_of_bytes(file.bytes());
    EXPECT_EQ(found.size(), 3U);
    EXPECT_TRUE(one_says(found, {"g.gadget2: particle 11 has a position that is not finite"}));
    EXPECT_TRUE(one_says(found, {"g.gadget2: particle 12 and 1 more have a velocity that is not finite"}));
    EXPECT_TRUE(one_says(found, {"g.gadget2: particle 10 has a mass that is not finite"}));
}

TEST(Gadget2, G25_ANegativeMassIsRefused)
{
    GadgetFile file({0, 0, 5, 0, 0, 0}, {});
    file.own_masses[2] = -1;
    const bool refused = only_says(problems_of_bytes(file.bytes()), {"particle 12 has a negative mass"});
    test::expect_at_least("refusals that name the particle, of one", refused ? 1 : 0, 1);
    for (const double mass : {-1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_TRUE(
            only_says(problems_of_bytes(GadgetFile({0, 1, 0, 0, 0, 0}, {0, mass, 0, 0, 0, 0}).bytes()),
                      {"the header has the mass", "of type 1, halo"}));
}

TEST(Gadget2, AMassTooLargeForAFloatIsRefused)
{
    EXPECT_TRUE(only_says(problems_of_bytes(GadgetFile({0, 1, 0, 0, 0, 0}, {0, 1e39, 0, 0, 0, 0}).bytes()),
                          {"particle 10 has a mass that is not finite"}));
}

TEST(Gadget2, AnIdTwiceIsRefused)
{
    GadgetFile file = halo_and_disc();
    file.ids[4] = file.ids[1];
    EXPECT_TRUE(only_says(problems_of_bytes(file.bytes()), {"the id 11 belongs to more than one particle"}));
}

TEST(Gadget2, CountsBeyondSenseAreRefusedBeforeAnythingIsAllocated)
{
    GadgetFile file = halo_and_disc();
    const auto faulty = [&](std::int32_t count) {
        file.counts[1] = count;
        return problems_of_bytes(file.bytes());
    };
    EXPECT_TRUE(only_says(faulty(-1), {"the header has -1 particles of type 1, halo"}));
    EXPECT_TRUE(only_says(faulty(std::numeric_limits<std::int32_t>::max()),
                          {"holds 2147483649 particles; at most 100000000 are read"}));
    EXPECT_TRUE(
        only_says(faulty(99'999'998), {"POS block is said to have 60 bytes where 1200000000 are expected"}));
}

TEST(Gadget2, ASnapshotOfSeveralFilesIsRefused)
{
    GadgetFile file = halo_and_disc();
    file.file_count = 4;
    EXPECT_TRUE(only_says(problems_of_bytes(file.bytes()), {"spread over 4 files; join them"}));
}

TEST(Gadget2, ATypeWithoutAKindInTheSceneIsRefusedWithTheRemedy)
{
    const Problems found = problems_of_bytes(halo_and_disc().bytes(), {{"disc", 1}});
    EXPECT_TRUE(only_says(
        found, {"3 particles of type 1 and the scene has no kind", "[[kind]] with name = \"halo\""}));
}

TEST(Gadget2, ReadsTheCollisionThatGadgetShips)
{
    const char* const folder = std::getenv("SLOD_DATA_DIR");
    const auto file = std::filesystem::path(folder != nullptr ? folder : "") / "galaxy-collision.gadget2";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "SLOD_DATA_DIR names no folder with galaxy-collision.gadget2";
    const auto result = read_gadget2(file, {{"halo", 1}, {"disc", 0.4}});
    ASSERT_TRUE(std::holds_alternative<ParticleSet>(result)) << std::get<Problems>(result).front();
    const ParticleSet& particles = std::get<ParticleSet>(result);
    ASSERT_EQ(particles.size(), 60'000U);
    // Two galaxies, at rest as a whole.
    double mass = 0, weight = 0;
    Vector3d momentum(0, 0, 0);
    for (std::size_t n = 0; n < particles.size(); ++n) {
        EXPECT_EQ(particles[n].kind, n < 40'000 ? 0 : 1);
        mass += double(particles[n].mass);
        momentum += double(particles[n].mass) * particles[n].velocity;
        weight += double(particles[n].mass) * particles[n].velocity.norm();
    }
    // The masses are published with eight decimals, 0.00104634 and 0.00023252.
    EXPECT_NEAR(mass, 40'000 * 0.00104634 + 20'000 * 0.00023252, 60'000 * 0.5e-8);
    // Velocities are sampled; 60,000 random directions leave about 1/sqrt(60,000) = 0.4 percent.
    EXPECT_LT(momentum.norm(), 0.01 * weight);
}

} // namespace

} // namespace slod::test
