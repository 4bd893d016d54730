// One evaluation of the forces between single particles, by number, accuracy and threads: time, error and
// cost.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/parallel.hpp"
#include "cost/bodies.hpp"
#include "cost/force_report.hpp"

namespace {

using namespace slod;

struct Table {
    std::string model = "plummer";
    std::vector<std::size_t> bodies{10'000, 100'000, 1'000'000};
    std::vector<double> accuracies{3e-4, 1e-3, 3e-3};
    std::vector<int> threads{1, int(std::max(std::thread::hardware_concurrency(), 1U))};
    double softening = 0.01;
    int repeats = 5;
};

/// All rows of a number of bodies and threads, each told to `row`.
template <class Row>
void measure(const Table& table, std::size_t count, int threads, const Row& row)
{
    ThreadTeam(threads).run([&] {
        const ParticleSet bodies = cost::cloud(count, 1, cost::cloud_model(table.model)->place);
        const cost::ExactForces exact = cost::exact_forces(bodies, table.softening);
        cost::ForceWorld world(bodies, table.softening);
        for (const double accuracy : table.accuracies) {
            const cost::ForceReport asked{.model = table.model,
                                          .bodies = count,
                                          .threads = threads,
                                          .softening = table.softening,
                                          .gravity = {.accuracy = accuracy}};
            row(cost::measure(world, exact, asked, table.repeats, cost::wall_milliseconds));
        }
    });
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures one evaluation of the forces in a cloud, with errors on 2000 of its bodies.");
    Table table;
    bool as_json = false;
    std::string csv;
    app.add_flag("--json", as_json, "Print all figures as one JSON object on the last line, too.");
    app.add_option("--csv", csv, "Write them to this file, too.")->option_text("FILE");
    app.add_option("--model", table.model, "plummer, clumps, disc or box.")
        ->check([](const std::string& name) {
            return cost::cloud_model(name) != nullptr ? std::string() : "there is no model " + name;
        })
        ->option_text("MODEL");
    app.add_option("--bodies", table.bodies, "Numbers of bodies.")
        ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}));
    app.add_option("--accuracy", table.accuracies, "Median errors to aim at; 0: the default settings.")
        ->check(CLI::Range(0.0, most_accuracy));
    app.add_option("--threads", table.threads, "Numbers of threads.")->check(CLI::Range(1, 256));
    app.add_option("--repeats", table.repeats, "Evaluations, of which times are medians.")
        ->check(CLI::Range(1, 1000));
    CLI11_PARSE(app, argc, argv);

    std::ofstream file;
    if (!csv.empty()) {
        file.open(csv);
        file << cost::csv_head() << '\n';
    }
    nlohmann::ordered_json rows;
    std::printf("%s\n", cost::table_head().c_str());
    for (const std::size_t count : table.bodies) {
        for (const int threads : table.threads) {
            measure(table, count, threads, [&](const cost::ForceReport& report) {
                std::printf("%s\n", cost::table_row(report).c_str());
                std::fflush(stdout);
                if (!csv.empty())
                    file << cost::csv_row(report) << '\n';
                rows.push_back(nlohmann::ordered_json::parse(cost::json_text(report)));
            });
        }
    }
    if (!csv.empty() && !file.flush()) {
        std::fprintf(stderr, "bench-gravity: cannot write %s\n", csv.c_str());
        return 1;
    }
    if (as_json)
        std::printf("%s\n", nlohmann::ordered_json{{"benchmark", "gravity"}, {"rows", rows}}.dump().c_str());
}
