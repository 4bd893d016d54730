#include <cmath>

#include <gtest/gtest.h>

#include "cost/figure5.hpp"
#include "cost/figure9.hpp"
#include "cost/paper_report.hpp"
#include "cost/paper_runs.hpp"
#include "support/small_scenes.hpp"

namespace slod::cost {
namespace {

/// A run whose clustered frames take 100 ms / (a size^exponent), beside baselines of 100 and of 10 ms.
PaperRun power_law(double a, double exponent)
{
    PaperRun run{.name = "toy", .baselines = {{"slow", 100}, {"fast", 10}}, .clustered = {}};
    for (const double size : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0})
        run.clustered.push_back({Motion::Flow, size, 100 / (a * std::pow(size, exponent))});
    return run;
}

TEST(Figure5, SpeedUpsAreRatiosOfTimes)
{
    const std::vector<SpeedUps> found = speed_ups(power_law(0.25, 1), paper_fountain);
    ASSERT_EQ(found.size(), 1U);
    ASSERT_EQ(found[0].over.size(), 2U);
    const std::array<double, 4> slow{2, 4, 8, 16}, fast{0.2, 0.4, 0.8, 1.6};
    for (std::size_t i = 0; i < slow.size(); ++i) { // three roundings
        EXPECT_NEAR(found[0].over[0].factors[i], slow[i], 1e-14 * slow[i]);
        EXPECT_NEAR(found[0].over[1].factors[i], fast[i], 1e-14 * fast[i]);
    }
}

TEST(Figure5, EachFactorMustBeAtLeastThePapers)
{
    EXPECT_TRUE(speed_ups(power_law(0.25, 1), paper_fountain)[0].over[0].at_least);
    EXPECT_FALSE(speed_ups(power_law(0.25, 1), paper_fountain)[0].over[1].at_least);
    PaperRun short_once = power_law(0.25, 1);
    short_once.clustered[3].ms = 100 / 3.06; // the paper has 3.07 at 16
    EXPECT_FALSE(speed_ups(short_once, paper_fountain)[0].over[0].at_least);
}

// A quarter of the size pays from 4 on over the slow one, where it is 1, and from 64 on over the fast one.
TEST(Figure5, ClustersPayFromTheSizeOnFromWhichAllDo)
{
    PaperRun run = power_law(0.25, 1);
    const auto over = speed_ups(run, paper_fountain)[0].over;
    EXPECT_EQ(over[0].break_even, 4);
    EXPECT_TRUE(over[0].in_time);
    EXPECT_EQ(over[1].break_even, 64);
    EXPECT_FALSE(over[1].in_time);
    run.clustered[4].ms = 101; // at 32
    EXPECT_EQ(speed_ups(run, paper_fountain)[0].over[0].break_even, 64);
    EXPECT_FALSE(speed_ups(power_law(0.001, 1), paper_fountain)[0].over[1].break_even);
}

TEST(Figure5, TheExponentIsThatOfThePower)
{
    EXPECT_NEAR(speed_ups(power_law(0.25, 0.9), paper_fountain)[0].exponent, 0.9, 1e-12);
    EXPECT_TRUE(speed_ups(power_law(0.25, 0.9), paper_fountain)[0].exponent_holds);
    EXPECT_FALSE(speed_ups(power_law(0.25, 1.3), paper_fountain)[0].exponent_holds);
    EXPECT_TRUE(speed_ups(power_law(0.25, 1.3), paper_galaxy)[0].exponent_holds);
    EXPECT_FALSE(speed_ups(power_law(0.25, 1.1), paper_galaxy)[0].exponent_holds);
}

// The figure's own factors grow by exponents within the bounds that claim A67 is tested by.
TEST(Figure5, ThePapersOwnFiguresPass)
{
    for (const PaperFigures* paper : {&paper_fountain, &paper_galaxy}) {
        PaperRun run{.name = "paper", .baselines = {{"without", 1}}, .clustered = {}};
        for (std::size_t i = 0; i < paper->sizes.size(); ++i)
            run.clustered.push_back({Motion::Rigid, paper->sizes[i], 1 / paper->factors[i]});
        const SpeedUps found = speed_ups(run, *paper)[0];
        EXPECT_NEAR(found.over[0].factors[3], paper->factors[3], 1e-12 * paper->factors[3]);
        EXPECT_TRUE(found.exponent_holds) << found.exponent;
    }
}

TEST(Figure5, TheReportSaysWhatHoldsOverWhom)
{
    const std::string report = text(power_law(0.25, 1), paper_fountain);
    for (const char* part :
         {"A  slow                              100.000 ms",
          "flow: all speed-ups are at least the paper's over A\n",
          "clusters pay over A from 4, over B from 64; the paper's from 6, which holds over A\n",
          "speed-up as size^1.00; the paper's from ^0.70 to ^1.05: holds\n"})
        EXPECT_NE(report.find(part), std::string::npos) << part << "\n" << report;
    const nlohmann::ordered_json json = json_of(power_law(0.25, 1), paper_fountain);
    EXPECT_TRUE(json["motions"][0]["over_baselines"][0]["at_least_the_papers"]);
    EXPECT_FALSE(json["motions"][0]["over_baselines"][1]["break_even_holds"]);
    EXPECT_EQ(json["runs"].size(), 6U);
}

const PaperPlan tiny{.motions = {Motion::Flow},
                     .sizes = {8, 16, 32, 64},
                     .settle_frames = 2,
                     .least_frames = 2,
                     .most_frames = 4,
                     .run_ms = 1};

/// A clock that is read and moves on by a millisecond.
Clock ticking()
{
    return [now = 0.0]() mutable { return now += 1; };
}

TEST(PaperRuns, TheGalaxyIsTimedBesideThreeBaselines)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace();
    ParticleSet stars;
    test::add_cloud(stars, {.count = 300}, 1);
    std::vector<std::string> announced;
    const PaperRun run = run_galaxy(scene, stars, tiny, ticking(),
                                    [&](const std::string& name) { announced.push_back(name); });
    EXPECT_EQ(announced.size(), 7U);
    ASSERT_EQ(run.baselines.size(), 3U);
    EXPECT_EQ(run.baselines[0].ms, 1); // between two readings of the clock, with none in between
    EXPECT_GT(run.baselines[1].ms, 1); // phases read it
    ASSERT_EQ(run.clustered.size(), 4U);
    EXPECT_EQ(run.clustered[3].size, 64);
    EXPECT_GT(run.clustered[3].phases[Phase::Forces], 0);
    EXPECT_EQ(speed_ups(run, paper_galaxy).size(), 1U);
}

TEST(PaperRuns, TheFountainIsFullAndTimedBesideThreeBaselines)
{
    SimulationSettings scene = test::quiet_settings();
    scene.uniform_gravity.emplace();
    scene.background.max_breadth = 2;
    scene.emitters = {test::jet("one"), test::jet("two")};
    const SimulationSettings filled = filled_fountain(scene, 3000);
    const std::size_t lifetime = lifetime_frames(filled);
    EXPECT_EQ(lifetime, 32U); // half a unit of time
    EXPECT_GE(filled.emitters[0].rate * 0.5 * 2, 3000);
    const PaperRun run = run_fountain(scene, 3000, tiny, ticking(), [](const std::string&) {});
    ASSERT_EQ(run.baselines.size(), 3U);
    EXPECT_EQ(run.clustered.size(), 4U);
    EXPECT_EQ(run.name,
              "fountain of " + std::to_string(int(filled.emitters[0].rate * 0.5 * 2)) + " droplets");
}

// The clock moves on at each reading, of which a frame has two for each phase: with regions there are more.
TEST(PaperRuns, WhoHasNoClustersHasNoRegionsEither)
{
    SimulationSettings scene = test::quiet_settings();
    scene.uniform_gravity.emplace();
    scene.background.max_breadth = 2;
    scene.emitters = {test::jet("one")};
    const PaperRun plain = run_fountain(scene, 1000, tiny, ticking(), [](const std::string&) {});
    scene.regions.emplace_back().name = "nozzle";
    scene.regions.back().partition.max_breadth = 2;
    const PaperRun with_region = run_fountain(scene, 1000, tiny, ticking(), [](const std::string&) {});
    EXPECT_EQ(with_region.baselines[1].ms, plain.baselines[1].ms);
}

TEST(Figure9, ShowsTheSameFountainThreeTimes)
{
    SimulationSettings scene = test::quiet_settings();
    scene.uniform_gravity.emplace();
    scene.background.max_breadth = 2;
    scene.emitters = {test::jet("one")};
    const std::vector<FountainView> views = view_fountain(scene, 1, ticking());
    ASSERT_EQ(views.size(), 3U);
    EXPECT_EQ(views[2].setting.name(), "rigid 30");
    EXPECT_NEAR(double(views[0].droplets.size()), 320, 1); // one may be at its end
    for (const FountainView& view : views) {
        EXPECT_EQ(view.droplets.size(), views[0].droplets.size());
        EXPECT_NEAR(view.ms, 1.0 / 21, 1e-15); // between two readings, the last 21 of 64 frames
    }
    const std::string report = text(views);
    EXPECT_NE(report.find("flow 30         0.048 ms a frame, 1.00 times as fast, the paper's 6\n"),
              std::string::npos)
        << report;
    const std::string script = side_by_side_script(views, "it's.svg");
    EXPECT_NE(script.find("set terminal svg size 1350,500\nset output 'it''s.svg'"), std::string::npos);
    EXPECT_NE(script.find("set title 'unclustered, 0.048 ms a frame'"), std::string::npos);
}

} // namespace
} // namespace slod::cost
