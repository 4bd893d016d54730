#include "scene_support.hpp"

#include <type_traits>

#include "core/random.hpp"
#include "scene/nearest.hpp"
#include "support/case_rows.hpp"

namespace slod::test {

namespace {

TEST(SceneReader, KeysThatAreAbsentKeepTheirDefaults)
{
    const Scene scene = scene_of(minimal_scene);
    EXPECT_EQ(scene.simulation.seed, SimulationSettings{}.seed);
    EXPECT_EQ(scene.simulation.motion.clock, MotionSettings{}.clock);
    EXPECT_EQ(scene.loop.server.frame_rate, ServerSettings{}.frame_rate);
    EXPECT_EQ(scene.wire.max_clusters, WireSettings{}.max_clusters);
}

TEST(SceneReader, TakesEachTypeOfValue)
{
    const Scene scene = scene_of("title = \"A title\"\nseed = 42\n" + minimal_scene +
                                 "[motion]\nkind = \"stream\"\nclock = 1\nlongest_life = 128\n"
                                 "[uniform_gravity]\nacceleration = [1, -2.5, 1e3]\n"
                                 "[wire]\nenabled = false\n");
    EXPECT_EQ(scene.title, "A title");
    EXPECT_EQ(scene.simulation.seed, 42U);
    EXPECT_EQ(scene.simulation.motion.motion, Motion::Stream);
    EXPECT_EQ(scene.simulation.motion.clock, 1.0) << "a TOML integer is a number too";
    EXPECT_EQ(scene.simulation.motion.longest_life, 128U);
    EXPECT_EQ(scene.simulation.uniform_gravity->acceleration, Vector3d(1, -2.5, 1e3));
    EXPECT_FALSE(scene.wire.enabled);
}

TEST(SceneReader, AnEffectIsActiveWhenItsTableIsThere)
{
    const Scene without = scene_of(minimal_scene);
    EXPECT_FALSE(without.simulation.gravity || without.simulation.uniform_gravity ||
                 without.simulation.linear_drag || without.simulation.uniform_wind);
    const Scene with =
        scene_of(minimal_scene + "[gravity]\n[uniform_gravity]\n[linear_drag]\n[uniform_wind]\n");
    EXPECT_TRUE(with.simulation.gravity && with.simulation.uniform_gravity && with.simulation.linear_drag &&
                with.simulation.uniform_wind);
}

TEST(SceneReader, KeepsArraysOfTablesInTheirOrder)
{
    const Scene scene = scene_of(minimal_scene + "[[kind]]\nname = \"dust\"\nsoftening = 2\n");
    ASSERT_EQ(scene.simulation.kinds.size(), 2U);
    EXPECT_EQ(scene.simulation.kinds[0].name, "star");
    EXPECT_EQ(scene.simulation.kinds[1].name, "dust");
    EXPECT_EQ(scene.simulation.kinds[1].softening, 2);
}

TEST(SceneReader, NamesFileAndLineOfASyntaxError)
{
    EXPECT_TRUE(only_says(problems_of("seed = 1\n\nseed = = 2\n"), {"s.toml:3: not TOML"}));
}

TEST(SceneReader, AMalformedLineIsASyntaxErrorLikeAnyOther)
{
    for (const std::string line :
         {"[=time]", "[[[kind]]]", "[.time]", "[t\xc3\xa9me]", "t = 1979-05-27T:7:00:00", "t = ]",
          "t = \xc3\xa9", "t = [1,,2]", "t = {a=}", "[", "t", "\xff", "\"t"})
        EXPECT_TRUE(only_says(problems_of("seed = 1\n" + line + "\n"), {"s.toml:", ": not TOML: "})) << line;
}

TEST(SceneReader, AKeyWrittenTwiceIsASyntaxError)
{
    EXPECT_TRUE(only_says(problems_of("seed = 1\nseed = 2\n"), {"s.toml:2: not TOML", "seed"}));
}

TEST(SceneReader, AnUnknownKeySuggestsTheNearest)
{
    EXPECT_TRUE(only_says(problems_of(minimal_scene + "[motion]\nclok = 2\n"),
                          {"s.toml:6: motion.clok = 2 is no key of [motion]; did you mean clock?"}));
    EXPECT_TRUE(only_says(problems_of("tilte = \"x\"\n" + minimal_scene),
                          {"s.toml:1: tilte", "did you mean title?"}));
}

TEST(SceneReader, AnUnknownKeyThatIsLikeNoneListsAll)
{
    EXPECT_TRUE(only_says(problems_of(minimal_scene + "[time]\nduration = 2\n"),
                          {"duration", "known are step, max_substeps, substep_angle."}));
}

TEST(SceneReader, ProblemsComeInTheOrderOfTheirLines)
{
    const Problems found = problems_of(
        minimal_scene + "[motion]\nclock = 100\n[time]\nstep = 0\n[meter]\nshare = 2\n" + "[nonsense]\n");
    ASSERT_EQ(found.size(), 4U);
    unsigned long last = 0;
    for (const std::string& problem : found) {
        const unsigned long line = std::stoul(problem.substr(problem.find(':') + 1));
        EXPECT_GT(line, last) << problem;
        last = line;
    }
}

TEST(SceneReader, N03_AStepOfLengthZeroIsRefused)
{
    const bool refused = only_says(problems_of(minimal_scene + "[time]\nstep = 0\n"), {"time.step", "1e-12"});
    expect_within("steps of length 0 refused, of 1", refused ? 1 : 0, 1, 1);
}

TEST(SceneReader, N04_ANegativeStepIsRefused)
{
    int refused = 0;
    for (const char* step : {"-0.01", "-1e-300", "-inf"})
        refused +=
            only_says(problems_of(minimal_scene + "[time]\nstep = " + step + "\n"), {"time.step"}) ? 1 : 0;
    expect_within("negative steps refused, of 3", refused, 3, 3);
}

TEST(SceneReader, AnUnknownTableSuggestsTheNearest)
{
    EXPECT_TRUE(
        only_says(problems_of(minimal_scene + "[uniform-gravity]\n"),
                  {"s.toml:5: [uniform-gravity] is no table of a scene; did you mean uniform_gravity?"}));
    EXPECT_TRUE(
        only_says(problems_of(minimal_scene + "[[emiter]]\n"), {"[emiter]", "did you mean emitter?"}));
}

TEST(SceneReader, AValueOfTheWrongTypeIsRefusedForEveryType)
{
    const auto faulty = [](const std::string& text) { return problems_of(minimal_scene + text); };
    EXPECT_TRUE(only_says(faulty("[time]\nstep = \"fast\"\n"),
                          {"s.toml:6: time.step = \"fast\" is no number; use "}));
    EXPECT_TRUE(
        only_says(faulty("[wire]\nenabled = 1\n"), {"s.toml:6: wire.enabled = 1 is neither true nor false"}));
    EXPECT_TRUE(only_says(faulty("[wire]\ndomain = 1.0\n"),
                          {"s.toml:6: wire.domain = 1.0 is no integer; use 0 to 230, without point"}));
    EXPECT_TRUE(only_says(faulty("[wire]\nprofile = 1\n"),
                          {"s.toml:6: wire.profile = 1 is no string; use one of loopback, lan."}));
    EXPECT_TRUE(only_says(faulty("[server]\nisa = true\n"),
                          {"s.toml:6: server.isa = true is no string; use one of auto, baseline, v3, v4."}));
    EXPECT_TRUE(
        only_says(faulty("[uniform_gravity]\nacceleration = 9.81\n"),
                  {"s.toml:6: uniform_gravity.acceleration = 9.81 is no vector; write three numbers"}));
    EXPECT_TRUE(only_says(faulty("[uniform_gravity]\nacceleration = [0, 1]\n"), {"[0, 1] is no vector"}));
    EXPECT_TRUE(
        only_says(faulty("[uniform_gravity]\nacceleration = [0, 1, \"x\"]\n"), {"is no vector of numbers"}));
    EXPECT_TRUE(only_says(faulty("[time]\nstep = 2020-01-01\n"), {"a date or time is no number"}));
}

TEST(SceneReader, ATableOfTheWrongShapeIsRefused)
{
    EXPECT_TRUE(
        only_says(problems_of("gravity = 3\n" + minimal_scene), {"s.toml:1: gravity = 3 is no table"}));
    EXPECT_TRUE(
        only_says(problems_of(minimal_scene + "[emitter]\n"), {"s.toml:5: emitter", "write [[emitter]]"}));
    EXPECT_TRUE(
        only_says(problems_of("emitter = [1, 2]\n" + minimal_scene), {"[1, 2] is no array of tables"}));
    EXPECT_TRUE(only_says(problems_of(minimal_scene + "[[time]]\n"), {"s.toml:5: time", "write [time]"}));
}

TEST(SceneReader, AValueOutOfItsRangeIsRefusedWithTheRange)
{
    const auto faulty = [](const std::string& text) { return problems_of(minimal_scene + text); };
    EXPECT_TRUE(only_says(faulty("[motion]\nclock = 10.5\n"),
                          {"s.toml:6: motion.clock = 10.5 is out of range; use 0.001 to 10."}));
    EXPECT_TRUE(
        only_says(faulty("[wire]\ndomain = -1\n"), {"wire.domain = -1 is out of range; use 0 to 230."}));
    EXPECT_TRUE(only_says(faulty("[wire]\ndomain = 9000000000\n"), {"domain = 9000000000 is out of range"}));
    EXPECT_TRUE(
        only_says(problems_of("seed = -1\n" + minimal_scene), {"seed = -1 is out of range; use 0 to "}));
    EXPECT_TRUE(faulty("[motion]\nclock = 10.0\n").empty()) << "bounds are inclusive";
    EXPECT_TRUE(faulty("[motion]\nclock = 0.001\n").empty()) << "bounds are inclusive";
}

TEST(SceneReader, AnUnknownEnumeratorSuggestsTheNearest)
{
    EXPECT_TRUE(only_says(problems_of(minimal_scene + "[motion]\nkind = \"rigd\"\n"),
                          {"s.toml:6: motion.kind = \"rigd\"", "did you mean rigid?"}));
}

TEST(SceneReader, NotANumberIsRefusedWithTheRange)
{
    const auto faulty = [](const std::string& text) { return problems_of(minimal_scene + text); };
    EXPECT_TRUE(only_says(faulty("[time]\nstep = nan\n"), {"time.step = nan is out of range"}));
    EXPECT_TRUE(only_says(faulty("[time]\nstep = inf\n"), {"time.step = inf is out of range"}));
    EXPECT_TRUE(
        only_says(problems_of("[[kind]]\nname=\"a\"\n[background]\nmax_breadth = 1\nspeed_floor = inf\n"),
                  {"background.speed_floor = inf is out of range; use at least 0."}));
    EXPECT_TRUE(only_says(problems_of("[[kind]]\nname=\"a\"\n[background]\nmax_breadth = nan\n"),
                          {"max_breadth = nan is out of range", "or inf"}));
    EXPECT_TRUE(only_says(problems_of("[[kind]]\nname=\"a\"\n[background]\nmax_breadth = -inf\n"),
                          {"max_breadth = -inf is out of range"}));
    EXPECT_TRUE(only_says(faulty("[uniform_gravity]\nacceleration = [0, 0, inf]\n"), {"is out of range"}));
}

/// A value of that type with `number` in it, as it stands in a scene; empty for one that has no numbers.
template <class T>
std::string written(const std::string& number)
{
    if constexpr (std::is_same_v<T, Vector3d>)
        return "[1, " + number + ", 1]";
    else if constexpr (std::is_same_v<T, NumberPairs>)
        return "[[0, " + number + "]]";
    else if constexpr (std::is_arithmetic_v<T>)
        return number;
    else
        return {};
}

// Every number of an emitter, by its list of fields, so that one that is added is tried too.
TEST(SceneReader, F32_AnEmitterOfNoNumbersIsRefusedKeyByKey)
{
    const std::string emitter = minimal_scene + "[[emitter]]\nname = \"e\"\nkind = \"star\"\n";
    int tried = 0, refused = 0;
    EmitterSettings settings;
    for_each_field(settings, [&]<class T>(const Field& field, const T&) {
        for (const std::string text : {"nan", "inf", "-inf"}) {
            const std::string line = written<T>(text);
            if (line.empty() || (text == "inf" && field.infinity_allowed))
                continue;
            ++tried;
            const bool does = one_says(problems_of(emitter + std::string(field.key) + " = " + line + "\n"),
                                       {"emitter.0." + std::string(field.key) + " = "});
            EXPECT_TRUE(does) << field.key << " = " << line;
            refused += does ? 1 : 0;
        }
    });
    EXPECT_GE(tried, 50);
    expect_at_least("refused, share of those tried", double(refused) / tried, 1);
    EXPECT_TRUE(
        only_says(problems_of(emitter + "direction = [0, 0, 0]\n"), {"emitter.0.direction = [0, 0, 0]"}));
}

TEST(SceneReader, InfinityIsTakenWhereAllowed)
{
    const Scene scene =
        scene_of(minimal_scene + "[[emitter]]\nname = \"e\"\nkind = \"star\"\nlifetime = inf\n");
    EXPECT_EQ(scene.simulation.emitters.at(0).lifetime, std::numeric_limits<double>::infinity());
}

TEST(SceneReader, AScheduleIsAListOfPairsOfNumbers)
{
    const std::string emitter = minimal_scene + "[[emitter]]\nname = \"e\"\nkind = \"star\"\n";
    const Scene scene = scene_of(emitter + "schedule = [[0, 5], [1.5, 2e3],]\n");
    EXPECT_EQ(scene.simulation.emitters.at(0).schedule, (NumberPairs{{0, 5}, {1.5, 2000}}));
    EXPECT_TRUE(scene_of(emitter + "schedule = []\n").simulation.emitters.at(0).schedule.empty());
    for (const std::string wrong : {"5", "[0, 5]", "[[0]]", "[[0, 5, 6]]", "[[0, 'a']]", "[{a = 1}]"})
        EXPECT_TRUE(only_says(problems_of(emitter + "schedule = " + wrong + "\n"),
                              {"emitter.0.schedule = ", "is no list of pairs"}))
            << wrong;
    for (const std::string beyond : {"[[-1, 5]]", "[[0, 1e13]]", "[[0, inf]]", "[[nan, 0]]"})
        EXPECT_TRUE(only_says(problems_of(emitter + "schedule = " + beyond + "\n"),
                              {"emitter.0.schedule = ", "is out of range; use 0 to 1000000000000 for each"}))
            << beyond;
}

TEST(SceneReader, ReportsAllProblemsTogether)
{
    const Problems found = problems_of("sead = 1\n"
                                       "[[kind]]\n"
                                       "name = \"Star\"\n"
                                       "[motion]\n"
                                       "clock = \"x\"\n"
                                       "longest_life = 3\n"
                                       "[tim]\n",
                                       {"wire.domain=500", "no equals sign"});
    EXPECT_TRUE(one_says(found, {"s.toml:1: sead"}));
    EXPECT_TRUE(one_says(found, {"s.toml:3: kind.0.name"})) << "found by problems(SimulationSettings)";
    EXPECT_TRUE(one_says(found, {"s.toml:5: motion.clock"}));
    EXPECT_TRUE(one_says(found, {"s.toml:6: motion.longest_life"}));
    EXPECT_TRUE(one_says(found, {"s.toml:7: [tim]"}));
    EXPECT_TRUE(one_says(found, {"--set wire.domain=500: wire.domain"}));
    EXPECT_TRUE(one_says(found, {"--set no equals sign: "}));
    EXPECT_TRUE(one_says(found, {"s.toml: background.max_breadth"})) << "in no line of the file";
    EXPECT_EQ(found.size(), 8U);
}

TEST(SceneReader, AFaultyKeyIsReportedOnce)
{
    // The name stays empty, which by itself would be a second problem of the same key.
    EXPECT_TRUE(
        only_says(problems_of("[[kind]]\nname = 3\n[background]\nmax_breadth = 1\n"), {"kind.0.name = 3"}));
}

TEST(SceneReader, AProblemIsOneLineWhateverTheFileHolds)
{
    const Problems found =
        problems_of("\"a\\nb\" = 1\n[[kind]]\nname = \"x\\ny\"\n[background]\nmax_breadth = 1\n");
    EXPECT_EQ(found.size(), 2U);
    for (const std::string& problem : found)
        EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
}

TEST(SceneReader, AFileThatCannotBeReadIsNamed)
{
    const ScratchFolder folder;
    const auto say = [](const std::filesystem::path& file) {
        return std::get<Problems>(load_scene(file, {}));
    };
    EXPECT_TRUE(only_says(say(folder.path() / "none.toml"), {"none.toml: there is no such file"}));
    EXPECT_TRUE(only_says(say(folder.path()), {folder.path().string() + ": this is a folder"}));
    EXPECT_TRUE(only_says(say("/dev/zero"), {"/dev/zero: longer than"}));
}

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps)
{
    EXPECT_EQ(edit_distance("clock", "clock"), 0U);
    EXPECT_EQ(edit_distance("clock", "clok"), 1U);
    EXPECT_EQ(edit_distance("clok", "clock"), 1U);
    EXPECT_EQ(edit_distance("clock", "cluck"), 1U);
    EXPECT_EQ(edit_distance("clcok", "clock"), 1U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

} // namespace

} // namespace slod::test
