// What effects of place cost, each alone and in pairs: T(A + B) beside T + dT(A) + dT(B), which are the same
// where no effect is paid for by another.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "sim/simulation.hpp"
#include "support/field_tables.hpp"

namespace {

using namespace slod;
using Clock = std::chrono::steady_clock;

/// Particles alone, uniform in the cube about the origin that default settings act in.
ParticleSet uniform(std::size_t count)
{
    ParticleSet particles(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(1, 0, i);
        for (double& coordinate : particles[i].position)
            coordinate = 2 * random.uniform() - 1;
        particles[i].id = i + 1;
        particles[i].mass = 1;
    }
    return particles;
}

SimulationSettings resisting_air()
{
    SimulationSettings settings;
    settings.kinds.push_back({"dust", 0});
    settings.background.max_cluster_size = 1;
    settings.background.max_breadth = 4;
    settings.time.step = 1e-3; // all stay where the effects are
    settings.linear_drag.emplace();
    return settings;
}

/// The effect of place in this row of their list, of default settings.
void add_field(FieldSettings& fields, std::size_t wanted)
{
    std::size_t row = 0;
    for_each_field_table(fields, [&]<class F>(typename F::Table& table) {
        if (row++ == wanted)
            test::add_element(table, typename F::Settings{});
    });
}

SimulationSettings settings_with(const std::vector<std::size_t>& fields)
{
    SimulationSettings settings = resisting_air();
    for (const std::size_t field : fields)
        add_field(settings.fields, field);
    return settings;
}

class Run {
public:
    Run(std::vector<std::size_t> fields, const ParticleSet& particles)
        : fields_(std::move(fields)), simulation_(settings_with(fields_), particles, {})
    {}

    void frame()
    {
        const Clock::time_point start = Clock::now();
        simulation_.step({});
        frames_ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }

    double median_ms() const
    {
        std::vector<double> sorted = frames_ms_;
        std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
        return sorted[sorted.size() / 2];
    }

    const std::vector<std::size_t>& fields() const { return fields_; }

private:
    std::vector<std::size_t> fields_;
    Simulation simulation_;
    std::vector<double> frames_ms_;
};

std::string_view name_of(std::size_t field)
{
    return effect_names[first_field_effect + field];
}

/// None, each, and each pair, in this order.
std::vector<Run> all_runs(const ParticleSet& particles)
{
    std::vector<Run> runs;
    runs.emplace_back(std::vector<std::size_t>{}, particles);
    for (std::size_t one = 0; one < AllFields::size; ++one)
        runs.emplace_back(std::vector{one}, particles);
    for (std::size_t one = 0; one < AllFields::size; ++one)
        for (std::size_t other = one + 1; other < AllFields::size; ++other)
            runs.emplace_back(std::vector{one, other}, particles);
    return runs;
}

nlohmann::ordered_json measure(std::size_t count, int frames)
{
    std::vector<Run> runs = all_runs(uniform(count));
    for (int frame = 0; frame < frames; ++frame) // in turns, so that all are disturbed alike
        for (Run& run : runs)
            run.frame();
    const double none = runs.front().median_ms();
    std::printf("%zu particles, median of %d frames; without any effect of place %.3f ms\n", count, frames,
                none);
    nlohmann::ordered_json result{{"particles", count}, {"frames", frames}, {"none_ms", none}};
    std::vector<double> costs;
    for (const Run& run : runs) {
        if (run.fields().size() == 1) {
            costs.push_back(run.median_ms() - none);
            std::printf("%-24s %8.3f ms more\n", std::string(name_of(run.fields()[0])).c_str(), costs.back());
            result["ms_more"][std::string(name_of(run.fields()[0]))] = costs.back();
        } else if (run.fields().size() == 2) {
            const std::size_t one = run.fields()[0], other = run.fields()[1];
            const std::string pair = std::string(name_of(one)) + " + " + std::string(name_of(other));
            const double off = run.median_ms() / (none + costs[one] + costs[other]) - 1;
            std::printf("%-24s %8.3f ms, %+6.1f %% beside the sum\n", pair.c_str(), run.median_ms(),
                        100 * off);
            result["beside_sum"][pair] = off;
        }
    }
    return result;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("What effects of place cost, alone and in pairs", "bench-effects");
    std::size_t particles = 100'000;
    int frames = 41;
    bool json = false;
    app.add_option("--particles", particles, "Single particles")->check(CLI::Range(1, 10'000'000));
    app.add_option("--frames", frames, "Frames of each run")->check(CLI::Range(1, 10'000));
    app.add_flag("--json", json, "End with one JSON object on a line");
    CLI11_PARSE(app, argc, argv);
    const nlohmann::ordered_json result = measure(particles, frames);
    if (json)
        std::printf("%s\n", result.dump().c_str());
    return 0;
}
