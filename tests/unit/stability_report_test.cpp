#include <limits>

#include <gtest/gtest.h>

#include "report/page.hpp"
#include "report/pictures.hpp"
#include "report/tables.hpp"
#include "support/scratch_folder.hpp"
#include "support/well_formed.hpp"

namespace slod::report {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Catalogue catalogue()
{
    return {.cases = {{"G01", "Energy stays bounded."},
                      {"G02", "Errors fall with the square of the step.", "a < b & \"c\", d"},
                      {"F28", "A swarm is bounded.", "", "There are no swarms."},
                      {"S04", "A chain of merges keeps the limit."}},
            .problems = {}};
}

TestRun kepler(double error)
{
    return {.test = "KeplerOrbit.G01_KeepsItsEnergy",
            .number = "G01",
            .passed = error <= 1e-5,
            .rows = {{"error of the energy", error, {.most = 1e-5}}, {"turns", 1000}}};
}

/// One of a test's runs, each with a parameter of its own.
TestRun slope(const std::string& parameter, double value)
{
    return {.test = "Orders/KeplerOrbit.G02_Converges/" + parameter,
            .number = "G02",
            .passed = value >= 1.9,
            .rows = {{"slope", value, {1.9, 2.1}}}};
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(StabilityReport, HasTheMeasuredValueBesideItsLimit)
{
    const Findings findings = find(catalogue(), {{kepler(3.9e-6)}, {}});
    EXPECT_EQ(findings.problems, Problems{});
    EXPECT_EQ(findings.summary(), "1 of 4 cases passed, 0 failed, 1 struck, 2 not run");
    const std::string table = table_text(findings);
    EXPECT_TRUE(has(table, "G01  passed: Energy stays bounded.\n     by KeplerOrbit.G01_KeepsItsEnergy\n"))
        << table;
    EXPECT_TRUE(has(table, " 3.9e-06  at most 1e-05            yes\n")) << table;
    EXPECT_TRUE(has(table, "S04  not run: A chain")) << table;
    EXPECT_TRUE(has(table, "F28  struck: A swarm is bounded.\n     struck: There are no swarms.\n")) << table;
    const std::string lines = csv_text(findings);
    EXPECT_TRUE(has(lines, "G01,Energy stays bounded.,error of the energy,3.9e-06,,1e-05,yes,passed,"
                           "KeplerOrbit.G01_KeepsItsEnergy,,\n"))
        << lines;
    EXPECT_TRUE(has(lines, ",turns,1000,,,,passed,")) << lines;
    EXPECT_TRUE(has(lines, "\"a < b & \"\"c\"\", d\",\n")) << lines;
}

TEST(StabilityReport, SaysWhatFailed)
{
    for (const double error : {2e-5, infinite, std::numeric_limits<double>::quiet_NaN()}) {
        const Findings findings = find(catalogue(), {{kepler(error)}, {}});
        EXPECT_EQ(findings.count(Outcome::Failed), 1);
        const std::string table = table_text(findings);
        EXPECT_TRUE(has(table, "G01  FAILED: ")) << table;
        EXPECT_TRUE(has(table, "  NO\n")) << table;
        EXPECT_TRUE(has(html_page(findings, {}, ""), "<td class=\"no\">FAILED</td>"));
    }
}

TEST(StabilityReport, TakesATestThatDidNotEndForOneThatFailed)
{
    TestRun crashed = kepler(0);
    crashed.passed = crashed.ended = false;
    const Findings findings = find(catalogue(), {{crashed}, {}});
    EXPECT_EQ(findings.count(Outcome::Failed), 1);
    EXPECT_TRUE(has(table_text(findings), "G01_KeepsItsEnergy, FAILED, did not end"));
}

TEST(StabilityReport, ShowsOfATestsParametersTheOneWithLeastRoom)
{
    const Findings findings = find(catalogue(), {{slope("0", 1.95), slope("1", 2.08), slope("2", 2.0)}, {}});
    const TestFindings& test = findings.cases[1].tests.at(0);
    EXPECT_EQ(findings.cases[1].tests.size(), 1U);
    EXPECT_EQ(test_text(test), "KeplerOrbit.G02_Converges, 3 runs");
    ASSERT_EQ(test.rows.size(), 1U);
    EXPECT_EQ(test.rows[0].measured, 2.08);
    const Findings failing = find(catalogue(), {{slope("0", 1.95), slope("1", 1.0)}, {}});
    EXPECT_EQ(test_text(failing.cases[1].tests.at(0)), "KeplerOrbit.G02_Converges, 2 runs, 1 FAILED");
    EXPECT_EQ(failing.cases[1].tests.at(0).rows.at(0).measured, 1.0);
}

TEST(StabilityReport, KeepsApartWhatIsHeldToOtherLimits)
{
    TestRun coarse = slope("0", 2.0);
    coarse.rows[0].limits = {1, 3};
    const Findings findings = find(catalogue(), {{coarse, slope("1", 2.0)}, {}});
    EXPECT_EQ(findings.cases[1].tests.at(0).rows.size(), 2U);
}

// No run of them leaves less room than another.
TEST(StabilityReport, ShowsWhatIsHeldToNothingAndPicturesOfEachParameter)
{
    std::vector<TestRun> runs{slope("8", 2.0), slope("16", 2.0)};
    for (TestRun& run : runs) {
        run.rows[0].limits = {};
        run.pictures.emplace_back().title = "Radii";
    }
    const Findings findings = find(catalogue(), {runs, {}});
    const TestFindings& test = findings.cases[1].tests.at(0);
    ASSERT_EQ(test.rows.size(), 2U);
    EXPECT_EQ(test.rows[0].quantity, "slope, 8");
    EXPECT_EQ(test.rows[1].quantity, "slope, 16");
    ASSERT_EQ(test.pictures.size(), 2U);
    EXPECT_EQ(test.pictures[1].title, "Radii, 16");
}

TEST(StabilityReport, KnowsATestByItsNameWithoutParameters)
{
    EXPECT_EQ(plain_name("Suite.G01_Name"), "Suite.G01_Name");
    EXPECT_EQ(plain_name("Instance/Suite.G01_Name/12"), "Suite.G01_Name");
    EXPECT_EQ(plain_name("Suite/0.G01_Name"), "Suite.G01_Name");
    EXPECT_EQ(plain_name("Instance/Suite/0.G01_Name"), "Suite.G01_Name");
}

TEST(StabilityReport, RefusesTestsOfUnknownAndOfStruckCases)
{
    TestRun unknown = kepler(0), struck = kepler(0);
    unknown.number = "G99";
    struck.number = "F28";
    const Findings findings = find(catalogue(), {{unknown, struck}, {}});
    ASSERT_EQ(findings.problems.size(), 2U);
    EXPECT_TRUE(has(findings.problems[0], "add [G99]")) << findings.problems[0];
    EXPECT_TRUE(has(findings.problems[1], "F28, which is struck")) << findings.problems[1];
    EXPECT_TRUE(
        has(table_text(findings), "\nerror: KeplerOrbit.G01_KeepsItsEnergy is a test of no known case"));
}

TEST(StabilityReport, CountsCasesThatRanAndHeldNothingToALimit)
{
    TestRun run = kepler(0);
    run.rows.erase(run.rows.begin());
    EXPECT_TRUE(has(find(catalogue(), {{run}, {}}).summary(), "; 1 ran and held nothing"));
    EXPECT_FALSE(has(find(catalogue(), {{kepler(0)}, {}}).summary(), ";"));
}

TEST(StabilityReport, MakesAWellFormedPageThatNeedsNoOtherFile)
{
    Catalogue odd = catalogue();
    odd.cases[0].claim = "|E| < 1e-5 && L > 0\x01";
    TestRun run = kepler(1e-6);
    run.rows[0].quantity = "<|dE|> & \"more\"";
    const Findings findings = find(odd, {{run, slope("0", 1)}, {"a<b.json: no & yes"}});
    const std::string svg = "<?xml version=\"1.0\"?>\n<svg width=\"9\"><path d=\"M0,0\"/></svg>\n";
    const std::string page = html_page(findings, {{"G01", svg}, {"S04", svg}}, "Here & <now>.");
    EXPECT_EQ(test::malformed(page), "") << page;
    for (const char* part : {"<svg width", "a&lt;b.json", "&lt;|dE|&gt; &amp; \"more\"",
                             "Here &amp; &lt;now&gt;.", "Struck: There are no swarms.", "Note: a &lt; b"})
        EXPECT_TRUE(has(page, part)) << part;
    for (const char* needed : {"<script", "src=", "href=", "@import", "url(", "<?xml"})
        EXPECT_FALSE(has(page, needed)) << needed;
}

TEST(StabilityReport, DrawsWhatTheAxesShow)
{
    const test::CasePicture picture{.title = "it's\ntwo lines",
                                    .x_axis = "t",
                                    .y_axis = "E",
                                    .curves = {{"a", {1, 2, 3}, {0, infinite, 4}}, {"b", {0, 1}, {-1, 0}}},
                                    .log_y = true};
    const std::string script = plot_script(picture, "G01_0", "it's.svg");
    EXPECT_TRUE(has(script, "$curve0 << END\n3 4\nEND\n")) << script;
    EXPECT_FALSE(has(script, "$curve1")) << script;
    EXPECT_TRUE(has(script, "set title 'it''s two lines' noenhanced\n")) << script;
    EXPECT_TRUE(has(script, "set output 'it''s.svg'\n")) << script;
    EXPECT_EQ(plot_script(test::CasePicture(), "G01_0", "x.svg"), "");
}

TEST(StabilityReport, HasThePicturesThatWereDrawn)
{
    TestRun run = kepler(0);
    run.pictures = {{.title = "Energy", .x_axis = "t", .y_axis = "E", .curves = {{"a", {1, 2}, {3, 4}}}},
                    {.title = "Nothing", .x_axis = "t", .y_axis = "E", .curves = {{"a", {}, {}}}}};
    Findings findings = find(catalogue(), {{run}, {}});
    const ScratchFolder folder;
    const auto pictures = draw_pictures(findings, folder.path() / "pictures");
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures[0].first, "G01");
    EXPECT_TRUE(has(pictures[0].second, "<svg")) << pictures[0].second;
    ASSERT_EQ(findings.problems.size(), 1U);
    EXPECT_TRUE(has(findings.problems[0], "\"Nothing\" has no point")) << findings.problems[0];
}

TEST(StabilityReport, ReadsWhatTestsWrite)
{
    const ScratchFolder folder;
    folder.write("b.json", R"({"test": "A.G01_B", "case": "G01", "passed": true, "ended": true, "rows":
        [{"quantity": "q", "measured": "nan", "least": "-inf", "most": 1e-5}], "pictures": [{"title": "t",
        "x_axis": "x", "y_axis": "y", "log_x": false, "log_y": true, "curves":
        [{"name": "c", "x": [1, 2], "y": [3, "inf"]}]}]})");
    folder.write("a.json", "{\"test\": \"A.G02_C\"}");
    folder.write("notes.txt", "not of ours");
    const TestRuns read = read_test_runs(folder.path());
    ASSERT_EQ(read.problems.size(), 1U);
    EXPECT_TRUE(has(read.problems[0], "a.json: ") && has(read.problems[0], "run its test again"))
        << read.problems[0];
    ASSERT_EQ(read.runs.size(), 1U);
    ASSERT_EQ(read.runs[0].rows.size(), 1U);
    EXPECT_EQ(read.runs[0].rows[0].limits.least, -infinite);
    EXPECT_FALSE(read.runs[0].rows[0].holds());
    ASSERT_EQ(read.runs[0].pictures.size(), 1U);
    EXPECT_EQ(read.runs[0].pictures[0].curves.at(0).y, (std::vector<double>{3, infinite}));
    EXPECT_EQ(read_test_runs(folder.path() / "none").problems.size(), 1U);
}

/// What is said of a catalogue with all cases of G, as many as there are, and this beside them.
Problems problems_of(const std::string& more, int cases = 37)
{
    std::string text;
    for (int i = 1; i <= cases; ++i)
        text += (i < 10 ? "[G0" : "[G") + std::to_string(i) + "]\nclaim = \"It holds.\"\n";
    const ScratchFolder folder;
    folder.write("G.toml", text + more);
    const Catalogue read = read_catalogue(folder.path());
    Problems own; // the files of the other families are missing
    for (const std::string& problem : read.problems)
        if (has(problem, "G.toml"))
            own.push_back(problem.substr(problem.find("G.toml")));
    EXPECT_EQ(read.problems.size(), own.size() + 3);
    return own;
}

TEST(CaseCatalogue, HasEveryCaseOnce)
{
    EXPECT_EQ(problems_of(""), Problems{});
    EXPECT_EQ(problems_of("", 36),
              Problems{"G.toml: no [G37]; add it, with a claim, and a reason if it is struck"});
}

TEST(CaseCatalogue, RefusesWhatIsNoCase)
{
    EXPECT_EQ(problems_of("[G38]\n").at(0),
              "G.toml:75: \"G38\" is no table of a case from G01 to G37; make it one or take it out");
    EXPECT_EQ(problems_of("clam = \"G37\"\n").at(0),
              "G.toml:75: no \"clam\" is known; a case has claim, note and struck");
    EXPECT_EQ(problems_of("note = 3\n").at(0),
              "G.toml:75: note has to be a text in double quotes with something in it");
    EXPECT_EQ(problems_of("[G37]\n", 36).at(0), "G.toml:73: G37 has no claim; say in a sentence what holds");
}

TEST(CaseCatalogue, NamesTheLineOfWhatIsNoToml)
{
    const ScratchFolder folder;
    folder.write("G.toml", "[G01]\nclaim = It holds.\n");
    const Problems problems = read_catalogue(folder.path()).problems;
    ASSERT_EQ(problems.size(), 4U);
    EXPECT_TRUE(has(problems[0], "G.toml:2: not TOML: ")) << problems[0];
}

} // namespace
} // namespace slod::report
