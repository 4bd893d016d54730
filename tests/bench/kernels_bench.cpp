// What the kernels do in a second on one thread: pairs of the gravity kernels by precision, numbers and terms
// of waves of the others; by instruction set.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "simd/kernels.hpp"

namespace {

using namespace slod::simd;

/// An interaction list as gravity's group walk makes them; all of it stays in the first-level cache.
constexpr std::size_t target_count = 64;
constexpr std::size_t source_count = 512;

constexpr std::size_t round_count = 9;
constexpr std::chrono::milliseconds round_length(10);

template <class Real>
struct Arrays {
    std::array<std::vector<Real>, 4> at;     // x, y, z, q of the targets
    std::array<std::vector<Real>, 5> from;   // x, y, z, mass, q of the sources
    std::array<std::vector<Real>, 7> extent; // of those that are nodes, and its trace
    std::array<std::vector<Real>, 9> sums;

    Arrays()
    {
        std::mt19937_64 bits(1);
        std::uniform_real_distribution<Real> uniform(0, 1);
        const auto fill = [&](std::vector<Real>& array, std::size_t count) {
            array.resize(count);
            std::ranges::generate(array, [&] { return uniform(bits); });
        };
        for (auto& array : at)
            fill(array, target_count);
        for (auto& array : from)
            fill(array, source_count);
        for (auto& array : extent)
            fill(array, source_count);
        for (auto& array : sums)
            array.assign(target_count, 0);
    }

    GravityTargets<Real> targets()
    {
        return {target_count,   at[0].data(),   at[1].data(),   at[2].data(),   at[3].data(),
                sums[0].data(), sums[1].data(), sums[2].data(), sums[3].data(), sums[4].data(),
                sums[5].data(), sums[6].data(), sums[7].data(), sums[8].data()};
    }

    PotentialTargets<Real> potential_targets()
    {
        return {target_count, at[0].data(), at[1].data(), at[2].data(), at[3].data(), sums[0].data()};
    }

    GravitySources<Real> sources() const
    {
        return {source_count, from[0].data(), from[1].data(), from[2].data(), from[3].data(), from[4].data()};
    }

    GravityNodes<Real> nodes() const
    {
        return {sources(),        extent[0].data(), extent[1].data(), extent[2].data(),
                extent[3].data(), extent[4].data(), extent[5].data(), extent[6].data()};
    }
};

/// Calls per second of the best of some rounds: what disturbs only ever slows.
template <class Kernel>
double calls_per_second(const Kernel& kernel)
{
    using Clock = std::chrono::steady_clock;
    double best = 0;
    for (std::size_t round = 0; round < round_count; ++round) {
        const auto start = Clock::now();
        double calls = 0;
        std::chrono::duration<double> spent{};
        do {
            kernel();
            ++calls;
            spent = Clock::now() - start;
        } while (spent < round_length);
        best = std::max(best, calls / spent.count());
    }
    return best;
}

template <class Kernel>
double pairs_per_second(const Kernel& kernel)
{
    return double(target_count * source_count) * calls_per_second(kernel);
}

template <class Real>
nlohmann::ordered_json measure(const KernelTable& table)
{
    Arrays<Real> arrays;
    const auto targets = arrays.targets();
    const auto potential_targets = arrays.potential_targets();
    const auto sources = arrays.sources();
    const auto nodes = arrays.nodes();
    const GravityKernels<Real>& kernels = gravity_kernels<Real>(table);
    return {
        {"acceleration", pairs_per_second([&] { kernels.add_acceleration(targets, sources, no_self); })},
        {"acceleration_and_tide",
         pairs_per_second([&] { kernels.add_acceleration_and_tide(targets, sources, no_self); })},
        {"nodes", pairs_per_second([&] { kernels.add_nodes_acceleration(targets, nodes); })},
        {"nodes_and_tide",
         pairs_per_second([&] { kernels.add_nodes_acceleration_and_tide(targets, nodes); })},
        {"potential", pairs_per_second([&] { kernels.add_potential(potential_targets, sources, no_self); })},
    };
}

/// A block of newborns' random numbers and directions, and turbulence at a block of places.
nlohmann::ordered_json measure_others(const KernelTable& table)
{
    constexpr std::size_t count = 512, waves = 64, places = 64;
    std::array<std::vector<double>, 4> numbers;
    numbers.fill(std::vector<double>(count, 0.5));
    std::array<std::vector<double>, 8> of_waves;
    of_waves.fill(std::vector<double>(waves, 0.7));
    std::array<std::vector<double>, 15> at_places;
    at_places.fill(std::vector<double>(places, 0.3));
    const auto array = [](auto& all, std::size_t i) { return all[i].data(); };
    const Waves sum{waves,
                    {array(of_waves, 0), array(of_waves, 1), array(of_waves, 2)},
                    {array(of_waves, 3), array(of_waves, 4), array(of_waves, 5)},
                    array(of_waves, 6),
                    array(of_waves, 7)};
    const auto place = [&](std::size_t i) { return array(at_places, i); };
    const WavePlaces at{places,
                        {place(0), place(1), place(2)},
                        {place(3), place(4), place(5)},
                        {{place(6), place(7), place(8)},
                         {place(9), place(10), place(11)},
                         {place(12), place(13), place(14)}}};
    return {
        {"uniform_numbers",
         2 * count * calls_per_second([&] {
             table.numbers.fill_uniforms({{1, 2}, 3, 4, count}, 0, array(numbers, 0), array(numbers, 1));
         })},
        {"sines_and_cosines", count * calls_per_second([&] {
                                  table.numbers.sines_and_cosines(array(numbers, 0), count, array(numbers, 2),
                                                                  array(numbers, 3));
                              })},
        {"terms_of_waves", waves * places * calls_per_second([&] { table.waves.sum_up(sum, at); })},
    };
}

/// The names of what is in `rates`, in columns as print_row() has them.
void print_head(const nlohmann::ordered_json& rates)
{
    std::printf("%-10s %-10s", "isa", "precision");
    for (const auto& [kernel, rate] : rates.items())
        std::printf(" %22s", kernel.c_str());
    std::printf("\n");
}

void print_row(const char* isa, const char* precision, const nlohmann::ordered_json& rates)
{
    std::printf("%-10s %-10s", isa, precision);
    for (const auto& [kernel, rate] : rates.items())
        std::printf(" %22.3f", rate.get<double>() * 1e-9);
    std::printf("\n");
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures the kernels: 1e9 pairs, numbers and terms of waves per second, one thread.");
    bool as_json = false;
    app.add_flag("--json", as_json,
                 "Print what is done in a second as one JSON object on the last line, too.");
    CLI11_PARSE(app, argc, argv);

    nlohmann::ordered_json rates, others;
    for (const KernelTable* table : runnable_kernels()) {
        auto& in = rates[table->name];
        in["float"] = measure<float>(*table);
        in["double"] = measure<double>(*table);
        others[table->name] = measure_others(*table);
    }
    const char* const fastest = kernels().name;
    print_head(rates[fastest]["float"]);
    for (const auto& [isa, of] : rates.items()) {
        print_row(isa.c_str(), "float", of["float"]);
        print_row(isa.c_str(), "double", of["double"]);
    }
    print_head(others[fastest]);
    for (const auto& [isa, of] : others.items())
        print_row(isa.c_str(), "double", of);
    if (as_json) {
        const nlohmann::ordered_json report = {
            {"benchmark", "kernels"},     {"threads", 1},       {"targets", target_count},
            {"sources", source_count},    {"fastest", fastest}, {"interactions_per_second", rates},
            {"others_per_second", others}};
        std::printf("%s\n", report.dump().c_str());
    }
}
