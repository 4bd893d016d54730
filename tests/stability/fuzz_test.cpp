#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "app/command_desk.hpp"
#include "app/input_log.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "scene/gadget2.hpp"
#include "scene/scene.hpp"
#include "support/case_rows.hpp"
#include "support/drifting_cloud.hpp"
#include "support/gadget_records.hpp"
#include "support/scratch_folder.hpp"

// Whatever is read is taken or refused with the name of its file: scenes, GADGET-2 files, input logs and
// commands, with bytes changed at random. Seeds are the numbers of the cases.
namespace slod::test {
namespace {

/// SLOD_FUZZ_CASES in the environment asks for more.
std::uint64_t case_count(std::uint64_t usual)
{
    const char* const asked = std::getenv("SLOD_FUZZ_CASES");
    return asked != nullptr ? std::strtoull(asked, nullptr, 10) : usual;
}

std::size_t below(Random& random, std::size_t bound)
{
    return bound == 0 ? 0 : random.bits() % bound;
}

/// Changes the text in one to eight places: letters that are hard to read, parts that are missing, repeated
/// or of another text, and numbers at the ends of their ranges.
std::string mutated(std::string text, const std::string& other, Random& random)
{
    constexpr std::string_view hard = "[]{}=\"'.,#\n\\-+e_x09:\0\x7f\xff\xc3";
    constexpr std::array<std::string_view, 12> values{"nan",  "-inf",   "1e400", "-1", "18446744073709551616",
                                                      "0",    "1e-320", "[]",    "{}", "true",
                                                      "\"\"", "0x7f"};
    for (std::size_t change = 1 + below(random, 8); change > 0; --change) {
        const std::size_t at = below(random, text.size() + 1);
        switch (random.bits() % 6) {
        case 0:
            text.erase(at, below(random, 40));
            break;
        case 1:
            text.insert(at, text.substr(below(random, text.size() + 1), below(random, 200)));
            break;
        case 2:
            text.insert(at, other.substr(below(random, other.size() + 1), below(random, 200)));
            break;
        case 3:
            text.insert(at, values[below(random, values.size())]);
            break;
        case 4:
            if (const std::size_t sign = text.find("= ", at); sign != std::string::npos)
                text.replace(sign + 2, text.find('\n', sign) - sign - 2,
                             values[below(random, values.size())]);
            break;
        default:
            if (at < text.size())
                text[at] = hard[below(random, hard.size())];
        }
    }
    return text;
}

/// A new file with this content in place of the last case's, which is faster than to write into that.
std::filesystem::path rewritten(const ScratchFolder& folder, const std::string& name,
                                const std::string& content)
{
    std::filesystem::remove(folder.path() / name);
    return folder.write(name, content);
}

/// How cases ended.
struct Outcomes {
    std::uint64_t taken = 0, refused = 0, nameless = 0;

    /// Each problem has to begin with the file's name, or the override's.
    void add(const Problems* problems, const std::string& file)
    {
        if (problems == nullptr) {
            ++taken;
            return;
        }
        ++refused;
        const bool named =
            !problems->empty() &&
            std::all_of(problems->begin(), problems->end(), [&](const std::string& problem) {
                return problem.find(file) != std::string::npos || problem.starts_with("--set ");
            });
        EXPECT_TRUE(named) << (problems->empty() ? "refused without a problem" : problems->front());
        nameless += named ? 0 : 1;
    }

    void report() const
    {
        report_value("cases taken", double(taken));
        expect_at_least("cases refused", double(refused), 1);
        expect_at_most("refused without the file's name", double(nameless), 0);
    }
};

std::vector<std::string> shipped_scenes()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(SLOD_SCENES))
        if (entry.path().extension() == ".toml")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const std::filesystem::path& file : files)
        texts.push_back(file_content(file));
    return texts;
}

TEST(Fuzz, N22_AnyTextIsASceneOrRefusedByName)
{
    const std::vector<std::string> scenes = shipped_scenes();
    ASSERT_GT(scenes.size(), 4U);
    Outcomes outcomes;
    for (std::uint64_t seed = 0; seed < case_count(2000); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, 0, 0);
        const std::string text =
            mutated(scenes[seed % scenes.size()], scenes[below(random, scenes.size())], random);
        const auto loaded = load_scene({.name = "s.toml", .text = text, .folder = SLOD_SCENES}, {});
        outcomes.add(std::get_if<Problems>(&loaded), "s.toml");
    }
    outcomes.report();
    expect_at_least("scenes taken", double(outcomes.taken), 1); // comments may hold anything
}

TEST(Fuzz, N22_AnyOverrideIsTakenOrRefusedByName)
{
    const std::vector<std::string> scenes = shipped_scenes();
    Outcomes outcomes;
    for (std::uint64_t seed = 0; seed < case_count(2000); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, 1, 0);
        const std::string& scene = scenes[seed % scenes.size()];
        const std::string line = mutated("background.max_breadth=0.5", scene, random);
        const auto loaded = load_scene({.name = "s.toml", .text = scene, .folder = SLOD_SCENES}, {line});
        outcomes.add(std::get_if<Problems>(&loaded), "s.toml");
    }
    outcomes.report();
}

/// A GADGET-2 file (SnapFormat 1, Springel 2005) of five halo particles with masses of their own.
std::string gadget_file()
{
    constexpr std::uint32_t count = 5;
    std::string header(256, '\0');
    const std::int32_t files = 1;
    std::memcpy(&header[4], &count, sizeof count);   // of type 1
    std::memcpy(&header[124], &files, sizeof files); // the snapshot's
    const std::vector<float> vectors(3 * count, 0.5F), masses(count, 1.5F);
    return record(header) + record(bytes_of(vectors)) + record(bytes_of(vectors)) +
           record(bytes_of<std::uint32_t>({7, 8, 9, 10, 11})) + record(bytes_of(masses));
}

TEST(Fuzz, N22_AnyBytesAreAGadgetFileOrRefusedByName)
{
    const ScratchFolder folder;
    const std::string whole = gadget_file();
    Outcomes outcomes;
    for (std::uint64_t seed = 0; seed < case_count(4000); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, 2, 0);
        std::string bytes = whole;
        for (std::size_t change = 1 + below(random, 4); change > 0; --change) {
            const std::size_t at = below(random, bytes.size());
            if (random.bits() % 8 == 0)
                bytes.erase(at, below(random, 300));
            else if (random.bits() % 8 == 0)
                bytes.insert(at, bytes.substr(below(random, bytes.size()), below(random, 64)));
            else
                bytes[at] = char(random.bits());
            if (bytes.empty())
                bytes = whole;
        }
        const auto read = read_gadget2(rewritten(folder, "g.gadget2", bytes), {{"halo", 1}});
        outcomes.add(std::get_if<Problems>(&read), "g.gadget2");
        if (const auto* particles = std::get_if<ParticleSet>(&read)) {
            const bool sound =
                std::all_of(particles->begin(), particles->end(), [](const Particle& particle) {
                    return particle.position.allFinite() && particle.velocity.allFinite() &&
                           particle.mass >= 0 && particle.mass < INFINITY;
                });
            EXPECT_TRUE(sound) << "a particle is no number";
        }
    }
    outcomes.report();
}

TEST(Fuzz, N22_AnyTextIsAnInputLogOrRefusedByName)
{
    const ScratchFolder folder;
    {
        InputLogWriter writer(folder.path(), {.version = "1",
                                              .scene_name = "a.toml",
                                              .scene_text = "seed = 1\n",
                                              .settings = {"time.step=0.5"},
                                              .input = {},
                                              .initial_source = "a"});
        for (std::uint64_t frame = 1; frame < 20; ++frame)
            writer.record({.frame = frame,
                           .kind = InputKind(frame % names(InputKind{}).size()),
                           .region = "core",
                           .settings = {{"centre", "[1.0, 2.0, 3.0]"}, {"follows", "\"a=b\""}}});
        writer.finish({.frames = 20, .state_hash = 0xfedc'ba98'7654'3210});
    }
    const std::string whole = file_content(folder.path() / "input.log");
    Outcomes outcomes;
    for (std::uint64_t seed = 0; seed < case_count(4000); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, 3, 0);
        const auto read = read_input_log(rewritten(folder, "fuzz.log", mutated(whole, whole, random)));
        outcomes.add(std::get_if<Problems>(&read), "fuzz.log");
    }
    outcomes.report();
}

/// A command as a client may garble it.
Request random_request(Random& random, std::uint64_t number)
{
    constexpr std::array<std::string_view, 9> kinds{"set",        "add_roi",    "move_roi",
                                                    "resize_roi", "set_roi",    "remove_roi",
                                                    "keep_alive", "checkpoint", "step"};
    constexpr std::array<std::string_view, 5> regions{"core", "rim", "background", "", "a b"};
    constexpr std::array<std::string_view, 8> keys{
        "max_cluster_size", "shape",  "gravity.strength", "background.max_breadth",
        "linear_drag.rate", "centre", "control.mode",     "effects.gravity"};
    constexpr std::array<std::string_view, 9> values{"4",    "\"box\"", "sphere",     "0.5", "[0, 1, 2]",
                                                     "true", "1e300",   "\"smooth\"", ""};
    const auto any = [&](const auto& list) { return std::string(list[below(random, list.size())]); };
    const auto garbled = [&](std::string text) {
        return random.bits() % 4 == 0 ? mutated(text, "max_breadth = 1", random) : text;
    };
    const auto size = [&] {
        constexpr std::array<double, 8> hard{0, -1, 1e30, 1e300, 1e-300, INFINITY, -INFINITY, NAN};
        return random.bits() % 4 == 0 ? hard[below(random, hard.size())] : 2 * random.uniform() - 0.2;
    };
    Request request{.client = {std::uint8_t(1 + random.bits() % 3)},
                    .number = number - (random.bits() % 8 == 0 ? random.bits() % 100 : 0),
                    .kind = garbled(any(kinds)),
                    .region = garbled(any(regions)),
                    .if_revision = random.bits() % 8 == 0 ? random.bits() : 0,
                    .lease_s = random.bits() % 4 == 0 ? size() : 0,
                    .frames = std::uint32_t(random.bits() % 3),
                    .centre = {size(), size(), size()},
                    .half_extent = {size(), size(), size()},
                    .radius = size()};
    for (std::size_t i = random.bits() % 4; i > 0; --i)
        request.settings.push_back({.key = garbled(any(keys)), .value = garbled(any(values))});
    return request;
}

// Requests as the inbox hands them on, with views between and a frame after every 16th.
TEST(Fuzz, N22_AnyCommandIsAppliedOrRefusedWithAReason)
{
    Simulation simulation = drifting_cloud(64);
    CommandDesk desk(simulation, {.max_clients = 8});
    std::uint64_t applied = 0, refused = 0, unexplained = 0, frame = 1;
    for (std::uint64_t number = 1; number <= case_count(20'000); ++number) {
        SCOPED_TRACE(number);
        Random random(number, 4, 0);
        const Answer answer = desk.handle(random_request(random, number), frame, CommandDesk::Clock::now());
        const bool done = answer.result == slod_v1_RESULT_APPLIED;
        ++(done ? applied : refused);
        const bool explained = done || !answer.text.empty();
        EXPECT_TRUE(explained) << answer.field << ": " << answer.text;
        unexplained += explained ? 0 : 1;
        if (number % 16 == 0) {
            simulation.step({});
            ++frame;
        }
        if (number % 512 == 0) {
            EXPECT_EQ(simulation.problems(), Problems{});
        }
    }
    EXPECT_EQ(simulation.problems(), Problems{});
    expect_at_least("commands applied", double(applied), 100);
    expect_at_least("commands refused", double(refused), 100);
    expect_at_most("refused without a reason", double(unexplained), 0);
}

} // namespace
} // namespace slod::test
