#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cost/bodies.hpp"
#include "cost/force_report.hpp"
#include "support/scratch_folder.hpp"

// What slod-cost forces measures with.
namespace slod::cost {
namespace {

ParticleSet cloud_of(const char* model, std::size_t count)
{
    return cloud(count, 1, cloud_model(model)->place);
}

// A share p of N bodies has a standard deviation of sqrt(p (1 - p) / N); five of them.
TEST(CostBodies, APlummerSphereHasItsMassWhereItShould)
{
    constexpr std::size_t count = 20'000;
    const ParticleSet bodies = cloud_of("plummer", count);
    const auto mass_within = [](double r) { return std::pow(r * r / (1 + r * r), 1.5); };
    for (const double radius : {0.3, 1.0, 3.0, 10.0}) {
        const auto inside = std::count_if(bodies.begin(), bodies.end(), [&](const Particle& body) {
            return body.position.norm() < radius;
        });
        const double share = mass_within(radius) / mass_within(20);
        EXPECT_NEAR(double(inside) / count, share, 5 * std::sqrt(share * (1 - share) / count)) << radius;
    }
    for (const Particle& body : bodies)
        ASSERT_LE(body.position.norm(), 20);
}

TEST(CostBodies, EveryModelHasMassOneAndIdsInOrder)
{
    for (const CloudModel& model : cloud_models()) {
        const ParticleSet bodies = cloud(100, 1, model.place);
        double mass = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            EXPECT_EQ(bodies[i].id, i + 1);
            mass += double(bodies[i].mass);
        }
        EXPECT_NEAR(mass, 1, 1e-6) << model.name;
    }
    EXPECT_EQ(cloud_model("cube"), nullptr);
}

class BodiesFile : public testing::Test {
protected:
    std::variant<ParticleSet, Problems> read(const std::string& text)
    {
        write_file(file_, text);
        return read_bodies(file_);
    }
    std::string problem(const std::string& text)
    {
        const auto result = read(text);
        const auto* problems = std::get_if<Problems>(&result);
        return problems != nullptr && problems->size() == 1 ? problems->front() : "";
    }

    ScratchFolder folder_;
    std::filesystem::path file_ = folder_.path() / "bodies.txt";
};

TEST_F(BodiesFile, IsReadALineABody)
{
    const auto result = read("\xEF\xBB\xBF# x y z mass\n1 2 3 0.5\n\n -1e3,0, 4\t2\r\n");
    ASSERT_TRUE(std::holds_alternative<ParticleSet>(result)) << std::get<Problems>(result).front();
    const auto& bodies = std::get<ParticleSet>(result);
    ASSERT_EQ(bodies.size(), 2);
    EXPECT_EQ(bodies[0].position, Vector3d(1, 2, 3));
    EXPECT_EQ(bodies[0].mass, 0.5F);
    EXPECT_EQ(bodies[1].position, Vector3d(-1000, 0, 4));
    EXPECT_EQ(bodies[1].id, 2);
}

TEST_F(BodiesFile, IsRefusedByTheLine)
{
    const auto at = [&](int line) { return file_.string() + ":" + std::to_string(line) + ": "; };
    EXPECT_EQ(problem("0 0 0 1\n1 2 3\n"),
              at(2) + "\"1 2 3\" is no body; write its x, y, z and mass, four numbers of at most 1e30.");
    EXPECT_EQ(problem("1 2 3 4 5\n").find(at(1)), 0);
    for (const char* const line : {"1 2 nan 4", "1,2,,3,4", "1,2,3,", ",1,2,3", "1.5.5 2 3", "1 2 3 4,"})
        EXPECT_EQ(problem(line).find(at(1)), 0) << line;
    EXPECT_EQ(problem("1 2 3 4 # mine\n").find(at(1)), 0);
    EXPECT_NE(problem("1 2 3 -4\n").find("has a mass below 0"), std::string::npos);
    EXPECT_EQ(problem("1e308 0 0 1\n").find(at(1)), 0);
    EXPECT_NE(problem("# nothing\n").find("no body in it"), std::string::npos);
}

TEST_F(BodiesFile, ThatIsNotThereIsNamed)
{
    const auto missing = read_bodies(folder_.path() / "none");
    ASSERT_TRUE(std::holds_alternative<Problems>(missing));
    EXPECT_EQ(std::get<Problems>(missing).front().find((folder_.path() / "none").string()), 0);
    EXPECT_TRUE(std::holds_alternative<Problems>(read_bodies(folder_.path())));
}

TEST_F(BodiesFile, HasItsOwnNumberOfBodies)
{
    const auto problem_with = [&](auto count, auto seed) {
        const auto bodies = bodies_of(file_.string(), count, seed);
        const auto* problems = std::get_if<Problems>(&bodies);
        return problems != nullptr ? problems->front() : "";
    };
    EXPECT_EQ(problem_with(std::nullopt, std::nullopt),
              file_.string() + ": there is no such file; models without one are plummer, clumps, disc, box.");
    write_file(file_, "1 2 3 4\n");
    EXPECT_EQ(problem_with(std::nullopt, std::nullopt), "");
    for (const std::string& problem :
         {problem_with(std::optional(1), std::nullopt), problem_with(std::nullopt, std::optional(2))})
        EXPECT_NE(problem.find(": a number of bodies and a seed are of models without a file"), problem.npos);
}

TEST(CostBodies, OfAModelAreAsManyAsAskedForAndOthersWithAnotherSeed)
{
    EXPECT_EQ(std::get<ParticleSet>(bodies_of("box", {}, {})).size(), 100'000U);
    EXPECT_EQ(std::get<ParticleSet>(bodies_of("box", 1, {}))[0].position,
              std::get<ParticleSet>(bodies_of("box", 1, 1))[0].position);
    const auto first = [](std::uint64_t seed) {
        const auto bodies = std::get<ParticleSet>(bodies_of("box", 7, seed));
        EXPECT_EQ(bodies.size(), 7U);
        return bodies[0].position;
    };
    EXPECT_EQ(first(1), first(1));
    EXPECT_NE(first(1), first(2));
}

TEST(CostForces, OfAPairAreNewtons)
{
    ParticleSet pair = cloud(2, 1, [](Random&) { return Vector3d(0, 0, 0); });
    pair[0].mass = 3;
    pair[1].mass = 5;
    pair[1].position = {0, 3, 0};
    const ExactForces exact = exact_forces(pair, 4); // r^2 = 3^2 + 4^2
    ASSERT_EQ(exact.bodies.size(), 2);
    EXPECT_NEAR(exact.accelerations[0].y(), 5 * 3 / 125.0, 1e-15);
    EXPECT_NEAR(exact.accelerations[1].y(), -3 * 3 / 125.0, 1e-15);
}

TEST(CostForces, ErrorsAreRelativeAndOrdered)
{
    ExactForces exact;
    std::vector<Vector3d> accelerations;
    for (std::size_t i = 0; i < 100; ++i) { // errors 0, 1, ..., 99 percent, downwards
        exact.bodies.push_back(i);
        exact.accelerations.emplace_back(0, 2, 0);
        accelerations.emplace_back(0, 2 + 2 * 0.01 * double(99 - i), 0);
    }
    exact.bodies.push_back(0);
    exact.accelerations.emplace_back(0, 0, 0); // has no relative error
    const ForceErrors errors = force_errors(accelerations, exact);
    EXPECT_NEAR(errors.median, 0.50, 1e-12);
    EXPECT_NEAR(errors.p90, 0.89, 1e-12);
    EXPECT_NEAR(errors.p99, 0.98, 1e-12);
    EXPECT_NEAR(errors.max, 0.99, 1e-12);
    EXPECT_NEAR(errors.rms, std::sqrt(99.0 * 199 / 6 / 1e4), 1e-12); // of 0..99 percent
}

// All pairs in float relative to the group: rounding alone, some 1e-6 of the largest pulls.
TEST(CostForces, OfAWorldAreThoseOfItsBodiesInTheirOrder)
{
    const ParticleSet bodies = cloud_of("plummer", 500);
    ForceWorld world(bodies, 0.01);
    const ForceTrial trial = measure_forces(world, exact_forces(bodies, 0.01), 1, [] { return 0.0; });
    EXPECT_GT(trial.error.max, 0);
    EXPECT_LT(trial.error.max, 1e-4);
    EXPECT_EQ(trial.counts.interactions, 500U * 499U);
}

TEST(CostForces, AReportHasAllFiguresAndTheNormalisedCost)
{
    ForceReport report{.model = "plummer", .bodies = 1000, .threads = 2, .softening = 0.01};
    report.trial.seconds = 0.5;
    report.rates = {.kernel = 4e6, .bare = 3e6};
    EXPECT_EQ(report.normalised_cost(), 0.5 * 4e6 / 1000);
    const auto json = nlohmann::json::parse(json_text(report));
    for (const char* key : {"n", "threads", "seconds", "build_seconds", "kernel_rate", "normalised_cost"})
        EXPECT_TRUE(json.contains(key)) << key;
    for (const char* key : {"median", "p90", "p99", "max", "rms"})
        EXPECT_TRUE(json["error"].contains(key)) << key;
}

// A tenth of a second each; what they come to depends on the machine.
TEST(CostForces, KernelRatesAreMeasured)
{
    const KernelRates rates = measure_kernel_rates(1, [clock = 0.0]() mutable { return clock += 100; });
    EXPECT_GT(rates.kernel, 0);
    EXPECT_GT(rates.bare, 0);
    EXPECT_EQ(rates.faster(), std::max(rates.kernel, rates.bare));
}

} // namespace
} // namespace slod::cost
