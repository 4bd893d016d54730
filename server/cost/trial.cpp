#include "cost/trial.hpp"

#include <chrono>
#include <limits>
#include <vector>

#include "cost/quantile.hpp"
#include "sim/simulation.hpp"

namespace slod::cost {
namespace {

/// Frames after the end in which accelerations are compared with exact ones: of 16, 32 and then 64 members
/// each, 944 together.
constexpr int meter_frames = 16;

AccelerationErrors measure_error(Simulation& simulation)
{
    if (!simulation.plan().has(Phase::Meter)) // all get what they should
        return {0, 0, 0, 0};
    for (int frame = 0; frame < meter_frames; ++frame)
        simulation.step({.error_pairs = std::numeric_limits<std::uint64_t>::max()});
    const ErrorEstimate error = simulation.error();
    if (error.samples == 0)
        return {};
    return {error.median.value, error.p90.value, error.p99.value, error.max};
}

} // namespace

double wall_milliseconds()
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

Trial run_trial(const SimulationSettings& settings, const ParticleSet& initial, const TrialLength& length,
                const Clock& clock, const std::function<void(int)>& progress)
{
    Simulation simulation(settings, initial,
                          {.isa = "auto", .tick = [&] { return std::int64_t(1e6 * clock()); }});
    Trial trial;
    std::vector<double> times;
    for (int frame = 0; frame < length.frames; ++frame) {
        StepProfile phases;
        const double begin = clock();
        for (std::uint32_t step = 0; step < length.steps; ++step) {
            const StepProfile& profile = simulation.step({}).profile;
            for (std::size_t phase = 0; phase < phase_count; ++phase)
                phases.milliseconds[phase] += profile.milliseconds[phase];
        }
        if (frame >= length.frames / 10) {
            times.push_back(clock() - begin);
            for (std::size_t phase = 0; phase < phase_count; ++phase)
                trial.phases.milliseconds[phase] += phases.milliseconds[phase];
        }
        progress(frame);
    }
    for (double& phase : trial.phases.milliseconds)
        phase /= double(times.size());
    trial.ms_median = quantile(times, 0.5);
    trial.ms_p10 = quantile(times, 0.1);
    trial.ms_p90 = quantile(times, 0.9);
    trial.clusters = simulation.snapshot({}).counts.clusters;
    trial.particles = simulation.particles();
    if (length.measures_error)
        trial.force = measure_error(simulation);
    return trial;
}

} // namespace slod::cost
