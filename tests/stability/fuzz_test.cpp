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

#include "app/input_log.hpp"
#include "core/random.hpp"
#include "fuzz/inputs.hpp"
#include "support/case_rows.hpp"
#include "support/gadget_records.hpp"
#include "support/scratch_folder.hpp"

// Whatever is read is taken or refused with the name of its file: scenes, GADGET-2 files, input logs and
// commands, with bytes changed at random. Seeds are the numbers of the cases. fuzz/inputs.hpp is what looks.
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

/// How cases ended.
struct Outcomes {
    std::uint64_t taken = 0, refused = 0, wrong = 0;

    void add(const Dealt& dealt)
    {
        ++(dealt.taken ? taken : refused);
        EXPECT_EQ(dealt.wrong, "");
        wrong += dealt.wrong.empty() ? 0 : 1;
    }

    void report() const
    {
        report_value("cases taken", double(taken));
        expect_at_most("not dealt with as they should be", double(wrong), 0);
    }
};

/// What is in the files of a folder and its folders, in the order of their names.
std::vector<std::string> contents(const std::filesystem::path& folder, std::string_view extension = "")
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && (extension.empty() || entry.path().extension() == extension))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const std::filesystem::path& file : files)
        texts.push_back(file_content(file));
    return texts;
}

std::vector<std::string> shipped_scenes()
{
    return contents(SLOD_SCENES, ".toml");
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
        outcomes.add(deal_with_scene(text));
    }
    outcomes.report();
    expect_at_least("cases refused", double(outcomes.refused), 1);
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
        outcomes.add(deal_with_scene(scene, {line}));
    }
    outcomes.report();
    expect_at_least("cases refused", double(outcomes.refused), 1);
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
        outcomes.add(deal_with_gadget2(bytes));
    }
    outcomes.report();
    expect_at_least("cases refused", double(outcomes.refused), 1);
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
        outcomes.add(deal_with_input_log(mutated(whole, whole, random)));
    }
    outcomes.report();
    expect_at_least("cases refused", double(outcomes.refused), 1);
}

/// What is made of random bytes, a few to some thousand each time.
template <class DealWith>
void expect_dealt_with(std::uint32_t stream, const DealWith& deal_with)
{
    Outcomes outcomes;
    for (std::uint64_t seed = 0; seed < case_count(200); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, stream, 0);
        std::string bytes(10 * below(random, 200), '\0');
        for (char& byte : bytes)
            byte = char(random.bits());
        outcomes.add(deal_with(bytes));
    }
    outcomes.report();
    expect_at_least("cases of which something was done", double(outcomes.taken), 100);
}

TEST(Fuzz, N22_AnyCommandIsAppliedOrRefusedWithAReason)
{
    expect_dealt_with(4, deal_with_commands);
}

TEST(Fuzz, N22_AnyOperationsOnTheTreeLeaveItSound)
{
    expect_dealt_with(5, deal_with_regions);
}

// What coverage led libFuzzer to (`./dev fuzz`), and whatever was once found wrong.
TEST(Fuzz, N22_TheCorpusIsDealtWithAsItShouldBe)
{
    const auto deal = [](const char* input, auto&& deal_with) {
        SCOPED_TRACE(input);
        Outcomes outcomes;
        const std::vector<std::string> corpus = contents(std::filesystem::path(SLOD_FUZZ_CORPUS) / input);
        EXPECT_FALSE(corpus.empty());
        for (const std::string& bytes : corpus)
            outcomes.add(deal_with(bytes));
        outcomes.report();
    };
    deal("scene", [](std::string_view text) { return deal_with_scene(text); });
    deal("gadget2", deal_with_gadget2);
    deal("input_log", deal_with_input_log);
    deal("commands", deal_with_commands);
    deal("regions", deal_with_regions);
}

} // namespace
} // namespace slod::test
