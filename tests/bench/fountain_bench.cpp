// The paper's fountain (O'Brien, Fisher and Lin 2001, section 6.1) at ten million droplets, against a loop
// over droplets without clusters. Both do the same in a frame: three streams of config/scenes/fountain.toml
// under gravity, linear drag and wind bear so many droplets of random directions and speeds; those of a
// certain age die; all move by the exact flow of the fields and bounce off a ground. Measured when as many
// die as are born.
//
// The simulation runs the scene as its users do: at 64 droplets per cluster, with all that it keeps for each
// droplet (an id, its own time of death) and each cluster. The flat loop (server/cost/flat_fountain.hpp) is
// as fast as we can make it, and does less: single precision, no ids, deaths for nothing by a ring of
// batches, births by a hash, a bounce to first order, arithmetic fused and in whole registers of the fastest
// instruction set. It should be as fast as memory or cache, which a STREAM triad over as many bytes shows:
// flat_gb_per_s and triad_gb_per_s. The triad's is the lower one where lines are read before they are
// overwritten, which STREAM does not count. Both have the same team of threads.
//
// The second part leaves out the ground: what is left is the cost of births, deaths and flight. The third
// adds the turbulence of config/scenes/turbulence.toml, with that scene's [motion]. The flat loop sums the
// same waves at every droplet, without the gradients that clusters need, with a cosine of five terms.
// ratio_turbulence is against that. A loop that calls the simulation's own Turbulence at every droplet is
// measured besides, as what a program with one implementation of the field would take: ratio_same_function.
//
// Frames of both alternate in rounds, so that what disturbs disturbs both. Figures are medians of the rounds'
// means; spreads are half the distance of their quartiles, as a share of the median.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/aligned.hpp"
#include "core/parallel.hpp"
#include "cost/flat_fountain.hpp"
#include "scene/scene.hpp"
#include "sim/simulation.hpp"
#include "simd/kernels.hpp"

namespace {

using namespace slod;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

struct Options {
    std::size_t particles = 10'000'000;
    double lifetime = 2.5; ///< s, the scene's
    double size = 64;      ///< droplets per cluster
    int threads = int(std::max(1U, std::thread::hardware_concurrency()));
    int rounds = 9, frames = 4; ///< of a round
    bool still = false;         ///< without turbulence alone
};

double milliseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double quantile(std::vector<double> values, double q)
{
    std::sort(values.begin(), values.end());
    return values[std::size_t(q * double(values.size() - 1))];
}

double median(const std::vector<double>& values)
{
    return quantile(values, 0.5);
}

double spread(const std::vector<double>& values)
{
    return 0.5 * (quantile(values, 0.75) - quantile(values, 0.25)) / median(values);
}

Scene load(const char* file)
{
    auto loaded = load_scene(std::filesystem::path(SLOD_SCENES) / file, {});
    if (const auto* problems = std::get_if<Problems>(&loaded))
        throw std::runtime_error(problems->front());
    return std::get<Scene>(loaded);
}

/// The shipped fountain in full flow over a ground, and what the flat loop has to know of it.
struct Fountain {
    SimulationSettings settings;
    std::size_t per_frame; ///< droplets that a stream bears
    std::size_t lifetime;  ///< frames

    enum class With { Nothing, Ground, GroundAndTurbulence };

    Fountain(const Options& options, With what) : settings(load("fountain.toml").simulation)
    {
        lifetime = std::size_t(options.lifetime / settings.time.step + 0.5);
        const std::size_t streams = settings.emitters.size();
        const std::size_t least = (options.particles + streams * lifetime - 1) / (streams * lifetime);
        per_frame = block_count(least, cost::flat_lanes) * cost::flat_lanes;
        for (EmitterSettings& emitter : settings.emitters) {
            emitter.start = 0;
            emitter.lifetime = options.lifetime;
            emitter.rate = double(per_frame) / settings.time.step;
        }
        settings.limits.max_particles = 2 * droplets();
        settings.background.max_cluster_size = options.size;
        if (what != With::Nothing) {
            settings.colliders.emplace_back(); // a plane
            settings.colliders.back().name = "ground";
        }
        if (what == With::GroundAndTurbulence) {
            const SimulationSettings eddies = load("turbulence.toml").simulation;
            settings.fields.of<Turbulence>() = eddies.fields.of<Turbulence>();
            settings.motion = eddies.motion;
        }
    }

    std::size_t droplets() const { return per_frame * lifetime * settings.emitters.size(); }
};

/// The simulation of a fountain, from when it is full, and what its frames took.
class Slod {
public:
    explicit Slod(const Fountain& fountain)
        : simulation_(fountain.settings, {},
                      {.isa = {}, .tick = [] {
                           return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
                       }})
    {
        for (std::size_t frame = 0; frame < fountain.lifetime + 32; ++frame)
            simulation_.step({});
    }

    void round(int frames)
    {
        StepProfile sum;
        const Clock::time_point start = Clock::now();
        for (int frame = 0; frame < frames; ++frame) {
            const Snapshot& snapshot = simulation_.step({});
            for (std::size_t phase = 0; phase < phase_count; ++phase)
                sum.milliseconds[phase] += snapshot.profile.milliseconds[phase];
            add_events(counts_, snapshot.counts);
            counts_.particles = snapshot.counts.particles;
            counts_.clusters = snapshot.counts.clusters;
        }
        ms_.push_back(milliseconds_since(start) / frames);
        for (std::size_t phase = 0; phase < phase_count; ++phase)
            phases_[phase].push_back(sum.milliseconds[phase] / frames);
        frames_ += frames;
    }

    const std::vector<double>& ms() const { return ms_; }
    double ms(Phase phase) const { return median(phases_[std::size_t(phase)]); }
    const FrameCounts& counts() const { return counts_; } ///< events are sums of all rounds
    double per_frame(std::uint64_t events) const { return double(events) / frames_; }
    double per_frame(std::uint64_t FrameCounts::*events) const { return per_frame(counts_.*events); }

private:
    Simulation simulation_;
    std::vector<double> ms_, phases_[phase_count];
    FrameCounts counts_;
    int frames_ = 0;
};

/// The flat loop, and what its frames took.
class Flat {
public:
    explicit Flat(const Fountain& fountain)
        : flat_(fountain.settings, fountain.per_frame, fountain.lifetime, simd::kernels().name),
          lifetime_(fountain.lifetime)
    {
        for (std::size_t frame = 0; frame < lifetime_; ++frame)
            flat_.step();
    }

    void round(int frames)
    {
        const Clock::time_point start = Clock::now();
        for (int frame = 0; frame < frames; ++frame)
            flat_.step();
        ms_.push_back(milliseconds_since(start) / frames);
    }

    /// One frame's calls of the simulation's own turbulence, at every droplet. What it says goes nowhere.
    void ask(const Turbulence& turbulence)
    {
        const Clock::time_point start = Clock::now();
        AlignedVector<float> speeds(block_count(flat_.alive(), block));
        for_each_block(flat_.alive(), block, [&](std::size_t first, std::size_t last) {
            FieldValue wind;
            {
                Asking asking(turbulence, 1);
                for (std::size_t i = first; i < last; ++i)
                    asking.add(flat_.position(i), wind);
            }
            speeds[first / block] = float(wind.value.norm());
        });
        asked_ms_.push_back(milliseconds_since(start));
    }

    const std::vector<double>& ms() const { return ms_; }
    double asked_ms() const { return median(asked_ms_); }
    double gb_per_s() const
    {
        return cost::FlatFountain::bytes_per_move * double(flat_.alive()) / median(ms_) * 1e-6;
    }

private:
    static constexpr std::size_t block = 4096;

    cost::FlatFountain flat_;
    std::size_t lifetime_;
    std::vector<double> ms_, asked_ms_;
};

/// STREAM's triad (McCalpin 1995) over as many bytes as the flat loop's arrays have.
class Triad {
public:
    explicit Triad(std::size_t droplets) : a_(2 * droplets, 0), b_(2 * droplets, 1), c_(2 * droplets, 2) {}

    void round(int frames)
    {
        const Clock::time_point start = Clock::now();
        for (int frame = 0; frame < frames; ++frame)
            for_each_block(a_.size(), 8192, [&](std::size_t first, std::size_t last) {
                cost::flat_kernels(simd::kernels().name).triad(a_.data(), b_.data(), c_.data(), first, last);
            });
        ms_.push_back(milliseconds_since(start) / frames);
    }

    double gb_per_s() const { return 3 * sizeof(float) * double(a_.size()) / median(ms_) * 1e-6; }

private:
    AlignedVector<float> a_, b_, c_;
    std::vector<double> ms_;
};

void print(const char* title, const Slod& slod, const Flat& flat)
{
    std::printf("%s: %.0f droplets in %.0f clusters\n", title, double(slod.counts().particles),
                double(slod.counts().clusters));
    std::printf("  flat loop %10.2f ms a frame, +- %.0f %%\n", median(flat.ms()), 100 * spread(flat.ms()));
    std::printf("  slod      %10.2f ms a frame, +- %.0f %%, of which\n", median(slod.ms()),
                100 * spread(slod.ms()));
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (const double ms = slod.ms(Phase(phase)); ms > 0)
            std::printf("    %-10.10s %8.2f\n", names(Phase{})[phase].data(), ms);
    std::printf("  in each frame");
    for (const char* name : {"born", "died", "struck", "taken_apart", "impacts", "reformed_members",
                             "crossings", "splits", "merges"})
        for (const EventCount& event : event_counts)
            if (event.name == name)
                std::printf("%s %.0f %s", name == std::string("born") ? "" : ",", slod.per_frame(event.count),
                            name);
    std::printf("\n");
}

/// Has each of `measured` run so many frames, by turns; calls after(round) at the end of each round.
template <class After, class... Measured>
void by_turns(const Options& options, const After& after, Measured&... measured)
{
    for (int round = 0; round < options.rounds; ++round) {
        (measured.round(options.frames), ...);
        after(round);
    }
}

constexpr auto nothing_more = [](int) {};

/// The flat loop and the simulation of a fountain without a ground, by turns.
Json measure_open(const Options& options)
{
    const Fountain fountain(options, Fountain::With::Nothing);
    Slod slod(fountain);
    Flat flat(fountain);
    by_turns(options, nothing_more, flat, slod);
    print("Fountain without a ground", slod, flat);
    return {
        {"flat_open_ms", median(flat.ms())},
        {"slod_open_ms", median(slod.ms())},
        {"ratio_open", median(flat.ms()) / median(slod.ms())},
        {"births_open_ms", slod.ms(Phase::Emit)},
        {"deaths_open_ms", slod.ms(Phase::Expire)},
        {"move_open_ms", slod.ms(Phase::Propagate)},
        {"reform_open_ms", slod.ms(Phase::Update)},
    };
}

/// Likewise over the ground.
Json measure_still(const Options& options)
{
    const Fountain fountain(options, Fountain::With::Ground);
    Slod slod(fountain);
    Flat flat(fountain);
    Triad triad(fountain.droplets());
    by_turns(options, nothing_more, flat, triad, slod);
    print("Fountain", slod, flat);
    return {
        {"particles", slod.counts().particles},
        {"clusters", slod.counts().clusters},
        {"born_share", slod.per_frame(&FrameCounts::born) / double(slod.counts().particles)},
        {"impacts_per_frame", slod.per_frame(slod.counts().impacts)},
        {"flat_ms", median(flat.ms())},
        {"flat_spread", spread(flat.ms())},
        {"slod_ms", median(slod.ms())},
        {"slod_spread", spread(slod.ms())},
        {"ratio", median(flat.ms()) / median(slod.ms())},
        {"births_ms", slod.ms(Phase::Emit)},
        {"deaths_ms", slod.ms(Phase::Expire)},
        {"move_ms", slod.ms(Phase::Propagate)},
        {"reform_ms", slod.ms(Phase::Update)},
        {"flat_gb_per_s", flat.gb_per_s()},
        {"triad_gb_per_s", triad.gb_per_s()},
    };
}

/// Likewise with turbulence; the flat loop took `still_ms` without.
Json measure_turbulent(const Options& options, double still_ms)
{
    const Fountain fountain(options, Fountain::With::GroundAndTurbulence);
    const Turbulence turbulence(*fountain.settings.fields.of<Turbulence>(), {fountain.settings.seed});
    Slod slod(fountain);
    Flat flat(fountain);
    const auto ask_now_and_then = [&](int round) {
        if (round % 3 == 0)
            flat.ask(turbulence);
    };
    by_turns(options, ask_now_and_then, flat, slod);
    print("Fountain in eddies", slod, flat);
    const double same_function = still_ms + flat.asked_ms();
    std::printf("  flat loop %10.2f ms a frame with the simulation's own turbulence\n", same_function);
    return {
        {"clusters_turbulence", slod.counts().clusters},
        {"flat_turbulence_ms", median(flat.ms())},
        {"flat_turbulence_spread", spread(flat.ms())},
        {"slod_turbulence_ms", median(slod.ms())},
        {"slod_turbulence_spread", spread(slod.ms())},
        {"ratio_turbulence", median(flat.ms()) / median(slod.ms())},
        {"flat_same_function_ms", same_function},
        {"ratio_same_function", same_function / median(slod.ms())},
        {"births_turbulence_ms", slod.ms(Phase::Emit)},
        {"deaths_turbulence_ms", slod.ms(Phase::Expire)},
        {"move_turbulence_ms", slod.ms(Phase::Propagate)},
        {"reform_turbulence_ms", slod.ms(Phase::Update)},
    };
}

} // namespace

int main(int argc, char** argv)
try {
    CLI::App app("Measures a fountain of many droplets against a loop over droplets.");
    bool as_json = false;
    Options options;
    app.add_flag("--json", as_json, "Print the figures as one JSON object on the last line, too.");
    app.add_option("--particles", options.particles, "Droplets alive, rounded up to whole registers.");
    app.add_option("--lifetime", options.lifetime, "Of a droplet [s].");
    app.add_option("--size", options.size, "Droplets per cluster.");
    app.add_option("--threads", options.threads, "Number of threads.");
    app.add_option("--rounds", options.rounds, "Rounds of frames.")->check(CLI::PositiveNumber);
    app.add_option("--frames", options.frames, "Frames of a round.")->check(CLI::PositiveNumber);
    app.add_flag("--still", options.still, "Leave out the part with turbulence.");
    CLI11_PARSE(app, argc, argv);

    Json report = {{"benchmark", "fountain"},
                   {"threads", options.threads},
                   {"isa", simd::kernels().name},
                   {"frames", options.rounds * options.frames}};
    ThreadTeam team(options.threads);
    team.run([&] { report.update(measure_still(options)); });
    team.run([&] { report.update(measure_open(options)); });
    if (!options.still)
        team.run([&] { report.update(measure_turbulent(options, report["flat_ms"])); });
    std::printf("ratio %.2f, without a ground %.2f", report["ratio"].get<double>(),
                report["ratio_open"].get<double>());
    if (!options.still)
        std::printf(", in eddies %.2f, with the same function %.2f", report["ratio_turbulence"].get<double>(),
                    report["ratio_same_function"].get<double>());
    std::printf("; flat loop %.1f GB/s, triad %.1f GB/s\n", report["flat_gb_per_s"].get<double>(),
                report["triad_gb_per_s"].get<double>());
    if (as_json)
        std::printf("%s\n", report.dump().c_str());
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench-fountain: %s\n", error.what());
    return 1;
}
