#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/report.hpp"
#include "app/status.hpp"

namespace slod {
namespace {

Snapshot snapshot(std::uint64_t frame, double forces_ms)
{
    Snapshot snapshot;
    snapshot.frame = frame;
    snapshot.time = 0.5 * double(frame);
    snapshot.counts.particles = 1'234'567;
    snapshot.counts.clusters = 20;
    snapshot.counts.born = 3;
    snapshot.counts.interactions = 100;
    snapshot.drained = {.particles = 1, .mass = 0.5, .momentum = {1, 0, -2}};
    snapshot.killed = {.particles = 2, .mass = 0.25, .momentum = {0, 3, 0}};
    snapshot.profile[Phase::Forces] = forces_ms;
    snapshot.regions.push_back(
        {.row = 0, .clusters = 20, .particles = 1'234'567, .max_cluster_size = 23.5, .max_breadth = 1});
    return snapshot;
}

/// A plan with forces and without emitters.
Plan gravity_plan()
{
    Plan plan;
    plan.runs[std::size_t(Phase::Forces)] = true;
    return plan;
}

nlohmann::json reported(const Scene& scene, const RunSummary& summary)
{
    return nlohmann::json::parse(report({.scene = scene,
                                         .plan = gravity_plan(),
                                         .summary = summary,
                                         .initial_source = "nowhere",
                                         .isa = "v3",
                                         .threads = 2}));
}

TEST(RunSummary, AddsUpEventsAndKeepsTheLastLevels)
{
    RunSummary summary;
    for (std::uint64_t frame = 1; frame <= 10; ++frame)
        summary.add(snapshot(frame, 1), 2);
    EXPECT_EQ(summary.frames, 10U);
    EXPECT_EQ(summary.time, 5);
    EXPECT_EQ(summary.events.born, 30U);
    EXPECT_EQ(summary.events.interactions, 1000U);
    EXPECT_EQ(summary.drained.mass, 5);
    EXPECT_EQ(summary.drained.momentum, Vector3d(10, 0, -20));
    EXPECT_EQ(summary.killed.mass, 2.5);
    EXPECT_EQ(summary.killed.momentum, Vector3d(0, 30, 0));
    EXPECT_EQ(summary.particles, 1'234'567U);
    EXPECT_EQ(summary.clusters, 20U);
}

// Mass 2 and energy 4: no momentum can be above sqrt(2 * 2 * 4) = 4. All ratios are exact.
TEST(Drift, IsRelativeToEachQuantitysOwnScale)
{
    const ConservedQuantities start{
        .mass = 2, .momentum = {0, 0, 0}, .angular_momentum = {0, 3, 4}, .kinetic_energy = 4};
    const ConservedQuantities end{
        .mass = 1, .momentum = {0, 2, 0}, .angular_momentum = {0, 3, 9}, .kinetic_energy = 5};
    const Drift change = drift(start, end);
    EXPECT_EQ(change.mass, -0.5);
    EXPECT_EQ(change.momentum, 0.5);
    EXPECT_EQ(change.angular_momentum, 1);
    EXPECT_EQ(change.kinetic_energy, 0.25);
}

TEST(Drift, IsNotANumberWhereThereWasNothing)
{
    const Drift change = drift({}, {.mass = 1});
    EXPECT_TRUE(std::isnan(change.mass));
    EXPECT_TRUE(std::isnan(change.angular_momentum));
}

// The keys are promised to those who read reports; losing one breaks them.
TEST(Report, HasThePromisedKeys)
{
    RunSummary summary;
    summary.add(snapshot(1, 1), 2);
    summary.state_hash = 0xabc;
    Scene scene;
    scene.title = "a scene";
    const nlohmann::json json = reported(scene, summary);
    for (const char* pointer :
         {"/scene", "/threads", "/isa", "/frames", "/particles", "/clusters", "/state_hash", "/processor_s",
          "/ms_per_frame/median", "/ms_per_frame/p99", "/phases/forces/ms_median", "/drift/mass",
          "/drift/momentum", "/drift/angular_momentum", "/drift/kinetic_energy", "/counts/born",
          "/counts/interactions", "/version", "/settings/time/step"})
        EXPECT_TRUE(json.contains(nlohmann::json::json_pointer(pointer))) << pointer;
    EXPECT_EQ(json["drained"]["mass"], 0.5);
    EXPECT_EQ(json["killed"]["mass"], 0.25);
    EXPECT_EQ(json["killed"]["momentum"], nlohmann::json({0.0, 3.0, 0.0}));
    EXPECT_EQ(json["scene"], "a scene");
    EXPECT_EQ(json["state_hash"], "0000000000000abc");
    std::size_t fields = 0;
    AllFields::for_each([&]<class F> { fields += HasBoundary<F> ? 2 : 1; });
    EXPECT_EQ(json["counts"].size(), event_counts.size() + fields);
}

// A file's name is any bytes; this one's is no UTF-8.
TEST(Report, WhatIsNoTextIsReplaced)
{
    const Scene scene;
    const RunSummary summary;
    const Plan plan = gravity_plan();
    const ReportedRun run{.scene = scene,
                          .plan = plan,
                          .summary = summary,
                          .initial_source = "bad\xff.gadget2",
                          .isa = "v3",
                          .threads = 2};
    EXPECT_EQ(nlohmann::json::parse(report(run))["initial"], "bad\xef\xbf\xbd.gadget2");
}

TEST(Report, HasTheClustersThatABoundaryCutOfEachEffectThatMayHaveOne)
{
    Snapshot one = snapshot(1, 1);
    std::uint64_t row = 0;
    for (FieldCount& count : one.counts.fields)
        count = {.calls = 1, .clusters = 100 + row, .straddling = 10 + row++};
    RunSummary summary;
    summary.add(one, 2);
    summary.add(one, 2);
    const nlohmann::json counts = reported({}, summary)["counts"];
    row = 0;
    AllFields::for_each([&]<class F> {
        EXPECT_EQ(counts.at(std::string(F::name)), 2 * (100 + row));
        const std::string name = std::string(F::name) + "_straddling";
        EXPECT_EQ(counts.contains(name), HasBoundary<F>) << name;
        if (HasBoundary<F>) {
            EXPECT_EQ(counts.value(name, 0U), 2 * (10 + row)) << name;
        }
        ++row;
    });
    for (const char* bounded : {"attractor", "buoyancy", "wind"})
        EXPECT_TRUE(counts.contains(std::string(bounded) + "_straddling")) << bounded;
}

TEST(Report, APhaseThatIsNotPlannedIsAbsent)
{
    RunSummary summary;
    summary.add(snapshot(1, 1), 2);
    const nlohmann::json phases = reported({}, summary)["phases"];
    EXPECT_EQ(phases.size(), 1U);
    EXPECT_FALSE(phases.contains("emit"));
}

TEST(Report, ARatioWithoutAScaleIsNull)
{
    EXPECT_TRUE(reported({}, {})["drift"]["mass"].is_null());
}

TEST(Report, SettingsAreThoseInEffect)
{
    Scene scene;
    scene.simulation.time.step = 0.25;
    scene.simulation.linear_drag = LinearDragSettings{.rate = 3};
    scene.simulation.emitters.resize(2);
    scene.simulation.emitters[1].name = "left";
    const nlohmann::json settings = reported(scene, {})["settings"];
    EXPECT_EQ(settings["time"]["step"], 0.25);
    EXPECT_EQ(settings["linear_drag"]["rate"], 3);
    EXPECT_FALSE(settings.contains("gravity")) << "the scene has none";
    EXPECT_EQ(settings["emitter"][1]["name"], "left");
    EXPECT_EQ(settings["emitter"][1]["lifetime"], "inf");
    EXPECT_EQ(settings["emitter"][1]["direction"], nlohmann::json({0.0, 0.0, 1.0}));
    EXPECT_EQ(settings["motion"]["kind"], "flow");
}

// The log's lines are made of the same.
TEST(Report, SettingsThatAnAccuracyChoosesAreThoseChosen)
{
    Scene scene;
    scene.simulation.gravity = GravitySettings{.accuracy = 3e-3};
    const nlohmann::json gravity = reported(scene, {})["settings"]["gravity"];
    EXPECT_EQ(gravity["accuracy"], 3e-3);
    EXPECT_EQ(gravity["force_tolerance"], with_accuracy(*scene.simulation.gravity).force_tolerance);
    EXPECT_NE(gravity["force_tolerance"], GravitySettings{}.force_tolerance) << "or nothing is seen";
}

TEST(Status, NamesThePlannedPhasesAlone)
{
    LoopMeans means;
    means.profile[Phase::Forces] = 7.5;
    means.profile[Phase::Emit] = 1;
    const Snapshot now = snapshot(8, 0);
    const Plan plan = gravity_plan();
    for (const std::string& text : {status_line({now, means, plan}), status_record({now, means, plan})}) {
        EXPECT_NE(text.find("7.5"), std::string::npos) << text;
        EXPECT_NE(text.find("forces"), std::string::npos) << text;
        EXPECT_EQ(text.find("emit"), std::string::npos) << text;
    }
}

// A narrow terminal cuts the line's end off.
TEST(Status, TheLongestPhaseComesFirst)
{
    LoopMeans means;
    means.profile[Phase::Update] = 2;
    means.profile[Phase::Forces] = 7;
    Plan plan = gravity_plan();
    plan.runs[std::size_t(Phase::Update)] = true;
    EXPECT_NE(status_line({snapshot(8, 0), means, plan}).find("forces 7.0 update 2.0"), std::string::npos);
}

TEST(Status, IsReadableForPeopleAndForPrograms)
{
    LoopMeans means;
    means.real_time_factor = 1;
    const std::string line = status_line({snapshot(8, 0), means, {}});
    EXPECT_NE(line.find(" 20 clusters of 1,234,567 particles  t "), std::string::npos) << line;
    EXPECT_NE(line.find("  x1.00:"), std::string::npos) << line;
    means.real_time_factor = 3.15576e15;
    EXPECT_NE(status_line({snapshot(8, 0), means, {}}).find("100 Myr/s"), std::string::npos);
    EXPECT_NE(status_record({snapshot(8, 0), means, {}}).find(" particles=1234567 "), std::string::npos);
}

TEST(Status, SaysHowTheFrameRateIsHeldWhereAnythingHoldsIt)
{
    const ControlReport held{.mode = ControlMode::Smooth, .state = ControlState::Holding, .target_ms = 26};
    EXPECT_NE(status_line({snapshot(8, 0), {}, {}, held}).find(" fps holding, size 23.5"), std::string::npos);
    EXPECT_NE(status_record({snapshot(8, 0), {}, {}, held}).find(" max_cluster_size=23.5 control=holding "),
              std::string::npos);
    EXPECT_EQ(status_line({snapshot(8, 0), {}, {}}).find("23.5"), std::string::npos);
}

TEST(Status, SaysTheErrorWithItsIntervalWhereItIsMeasured)
{
    ErrorEstimate error;
    error.samples = 700;
    error.median = {.value = 0.0031, .low = 0.0028, .high = 0.0035};
    error.p99.value = 0.07;
    EXPECT_NE(status_line({snapshot(8, 0), {}, {}, {}, error}).find("error 0.31 % (0.28 to 0.35)"),
              std::string::npos);
    EXPECT_NE(status_record({snapshot(8, 0), {}, {}, {}, error})
                  .find(" error_median=0.0031 error_p99=0.07 error_samples=700 "),
              std::string::npos);
    EXPECT_EQ(status_line({snapshot(8, 0), {}, {}}).find("error"), std::string::npos);
}

TEST(Report, TheErrorIsNothingOrWhatWasMeasured)
{
    EXPECT_TRUE(reported({}, {})["error"].is_null());
    RunSummary summary;
    summary.error.samples = 700;
    summary.error.median = {.value = 0.0031, .low = 0.0028, .high = 0.0035};
    const nlohmann::json error = reported({}, summary)["error"];
    EXPECT_EQ(error["samples"], 700);
    EXPECT_EQ(error["median"]["value"], 0.0031);
    EXPECT_EQ(error["median"]["high"], 0.0035);
}

} // namespace
} // namespace slod
