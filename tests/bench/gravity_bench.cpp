// One evaluation of the forces between single particles: by all pairs and by walks of the tree, of monopoles
// and of quadrupoles, time, cost and error.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/parallel.hpp"
#include "support/attracting_world.hpp"
#include "support/clouds.hpp"

namespace {

using namespace slod;

constexpr double softening = 0.01; // in scale radii
constexpr int round_count = 5;

/// Seconds of the best of some rounds: what disturbs only ever slows.
template <class Work>
double seconds(int rounds, const Work& work)
{
    using Clock = std::chrono::steady_clock;
    double best = 1e30;
    for (int round = 0; round < rounds; ++round) {
        const auto start = Clock::now();
        work();
        best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
    }
    return best;
}

struct Row {
    std::size_t bodies;
    const char* method;
    double build_s, forces_s;
    double interactions; ///< per body
    double nodes_tested; ///< per walk
    test::ForceErrors errors;

    double pairs_per_second() const { return interactions * double(bodies) / forces_s; }
};

ParticleSet make_cloud(const std::string& name, std::size_t bodies)
{
    if (name == "disc")
        return test::cloud(bodies, 4, test::in_exponential_disc);
    if (name == "box")
        return test::cloud(bodies, 3, test::in_unit_box);
    if (name == "clumps")
        return test::two_clumps(bodies, 1);
    return name == "spectrum" ? test::mass_spectrum(bodies, 2) : test::plummer_sphere(bodies, 1);
}

Row measure(test::AttractingWorld& world, const char* method, std::uint32_t direct_below,
            Multipoles multipoles = Multipoles::Monopole)
{
    const std::size_t bodies = world.view.body_count();
    const int rounds = direct_below > 0 && bodies > 50'000 ? 1 : round_count;
    world.settings.direct_below = direct_below;
    world.settings.multipoles = multipoles;
    const double build_s = seconds(round_count, [&] { world.rebuild(); });
    world.evaluate(); // for the pulls of the relative criterion
    ForceCounts counts;
    const double forces_s = seconds(rounds, [&] { counts = world.evaluate(); });
    return {bodies,
            method,
            build_s,
            forces_s,
            double(counts.interactions) / double(bodies),
            counts.groups > 0 ? double(counts.nodes_tested) / double(counts.groups) : 0,
            test::force_errors(world)};
}

std::vector<Row> measure_all(const std::string& cloud, const std::vector<std::size_t>& sizes, bool tide,
                             double tolerance)
{
    std::vector<Row> rows;
    for (const std::size_t bodies : sizes) {
        test::AttractingWorld world(make_cloud(cloud, bodies), softening);
        world.clusters().columns.tide = tide;
        world.settings.force_tolerance = tolerance;
        rows.push_back(measure(world, "direct", UINT32_MAX));
        rows.push_back(measure(world, "monopoles", 0));
        rows.push_back(measure(world, "quadrupoles", 0, Multipoles::Quadrupole));
    }
    return rows;
}

/// What a machine-free comparison counts: pairs that direct sums would have evaluated in the time, per body.
double equivalent_pairs(const Row& row, double rate)
{
    return (row.build_s + row.forces_s) * rate / double(row.bodies);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures one evaluation of the forces in a cloud, with errors on 1000 of its bodies.");
    bool as_json = false, tide = false;
    int threads = 1;
    double tolerance = GravitySettings{}.force_tolerance;
    std::string cloud = "sphere";
    std::vector<std::size_t> sizes{10'000, 100'000};
    app.add_flag("--json", as_json, "Print all figures as one JSON object on the last line, too.");
    app.add_flag("--tide", tide, "Sum tidal tensors, too.");
    app.add_option("--threads", threads, "Threads to use.")->check(CLI::Range(1, 256));
    app.add_option("--cloud", cloud, "A Plummer sphere, or another cloud of the tests.")
        ->check(CLI::IsMember({"sphere", "disc", "clumps", "spectrum", "box"}));
    app.add_option("--bodies", sizes, "Numbers of bodies.")->check(CLI::Range(1, 10'000'000));
    app.add_option("--tolerance", tolerance, "Of the relative opening criterion.");
    CLI11_PARSE(app, argc, argv);

    std::vector<Row> rows;
    ThreadTeam(threads).run([&] { rows = measure_all(cloud, sizes, tide, tolerance); });
    double rate = 0;
    for (const Row& row : rows)
        if (row.method == std::string("direct"))
            rate = std::max(rate, row.pairs_per_second());

    nlohmann::ordered_json runs;
    std::printf("%8s %-11s %9s %9s %9s %9s %10s %10s %12s\n", "bodies", "method", "build ms", "forces ms",
                "per body", "tested", "median", "p99", "equivalent");
    for (const Row& row : rows) {
        std::printf("%8zu %-11s %9.2f %9.2f %9.0f %9.0f %10.2e %10.2e %12.0f\n", row.bodies, row.method,
                    row.build_s * 1e3, row.forces_s * 1e3, row.interactions, row.nodes_tested,
                    row.errors.median, row.errors.p99, equivalent_pairs(row, rate));
        runs.push_back({{"bodies", row.bodies},
                        {"method", row.method},
                        {"build_ms", row.build_s * 1e3},
                        {"forces_ms", row.forces_s * 1e3},
                        {"interactions_per_body", row.interactions},
                        {"nodes_tested_per_walk", row.nodes_tested},
                        {"median_error", row.errors.median},
                        {"p99_error", row.errors.p99},
                        {"equivalent_pairs_per_body", equivalent_pairs(row, rate)}});
    }
    if (as_json) {
        const nlohmann::ordered_json report = {{"benchmark", "gravity"},
                                               {"cloud", cloud},
                                               {"threads", threads},
                                               {"tide", tide},
                                               {"force_tolerance", tolerance},
                                               {"direct_pairs_per_second", rate},
                                               {"runs", runs}};
        std::printf("%s\n", report.dump().c_str());
    }
}
