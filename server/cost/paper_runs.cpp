#include "cost/paper_runs.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "cost/flat_fountain.hpp"
#include "cost/plain_loops.hpp"
#include "cost/setting.hpp"
#include "sim/simulation.hpp"
#include "simd/kernels.hpp"

namespace slod::cost {
namespace {

/// Runs steps as the plan says, after those that settle; returns their mean time, and calls after() at the
/// end of each.
template <class Step, class After>
double mean_ms(const PaperPlan& plan, int settle, const Clock& clock, const Step& step, const After& after)
{
    for (int frame = 0; frame < settle; ++frame)
        step();
    double sum = 0;
    int frames = 0;
    while (frames < plan.least_frames || (frames < plan.most_frames && sum < plan.run_ms)) {
        const double begin = clock();
        step();
        sum += clock() - begin;
        ++frames;
        after();
    }
    return sum / frames;
}

template <class Step>
double mean_ms(const PaperPlan& plan, int settle, const Clock& clock, const Step& step)
{
    return mean_ms(plan, settle, clock, step, [] {});
}

/// One of the two with all that its runs have in common.
class Runner {
public:
    Runner(const SimulationSettings& scene, const ParticleSet& initial, const PaperPlan& plan,
           int settle_frames, const Clock& clock, const Announce& announce)
        : scene_(scene), initial_(initial), plan_(plan), settle_(settle_frames), clock_(clock),
          announce_(announce)
    {}

    template <class Step>
    Baseline baseline(const std::string& name, int settle, const Step& step) const
    {
        announce_(name);
        return {name, mean_ms(plan_, settle, clock_, step)};
    }

    Baseline unclustered(const std::string& name, const SimulationSettings& scene) const
    {
        announce_(name);
        return {name, run(with_setting(scene, {.max_cluster_size = 1})).ms};
    }

    std::vector<Clustered> clustered() const
    {
        std::vector<Clustered> all;
        for (const Motion motion : plan_.motions)
            for (const double size : plan_.sizes) {
                const Setting setting{motion, size};
                announce_(setting.name());
                all.push_back(run(with_setting(scene_, setting)));
                all.back().motion = motion;
                all.back().size = size;
            }
        return all;
    }

private:
    Clustered run(const SimulationSettings& settings) const
    {
        Simulation simulation(settings, initial_,
                              {.isa = "auto", .tick = [&] { return std::int64_t(1e6 * clock_()); }});
        Clustered outcome{};
        int frames = 0;
        StepProfile last;
        outcome.ms = mean_ms(
            plan_, settle_, clock_, [&] { last = simulation.step({}).profile; },
            [&] {
                ++frames;
                for (std::size_t phase = 0; phase < phase_count; ++phase)
                    outcome.phases.milliseconds[phase] += last.milliseconds[phase];
            });
        for (double& phase : outcome.phases.milliseconds)
            phase /= frames;
        return outcome;
    }

    const SimulationSettings& scene_;
    const ParticleSet& initial_;
    const PaperPlan& plan_;
    int settle_;
    const Clock& clock_;
    const Announce& announce_;
};

} // namespace

PaperRun run_galaxy(const SimulationSettings& scene, const ParticleSet& stars, const PaperPlan& plan,
                    const Clock& clock, const Announce& announce)
{
    const Runner runner(scene, stars, plan, plan.settle_frames, clock, announce);
    SimulationSettings by_pairs = scene, by_tree = scene;
    by_pairs.gravity->direct_below = std::numeric_limits<std::uint32_t>::max();
    by_tree.gravity->direct_below = 0;
    PaperRun run{
        .name = "galaxy of " + std::to_string(stars.size()) + " stars", .baselines = {}, .clustered = {}};
    PlainStars plain(scene, stars);
    run.baselines = {runner.baseline("plain direct sum in double", 0, [&] { plain.step(); }),
                     runner.unclustered("direct sum in whole registers", by_pairs),
                     runner.unclustered("tree without clusters", by_tree)};
    run.clustered = runner.clustered();
    return run;
}

std::size_t lifetime_frames(const SimulationSettings& scene)
{
    return std::size_t(scene.emitters.front().lifetime / scene.time.step + 0.5);
}

SimulationSettings filled_fountain(const SimulationSettings& scene, std::size_t droplets)
{
    SimulationSettings filled = scene;
    const std::size_t batches = scene.emitters.size() * lifetime_frames(scene);
    const std::size_t per_frame =
        block_count(block_count(droplets, batches), flat_lanes) * std::size_t(flat_lanes);
    for (EmitterSettings& emitter : filled.emitters) {
        emitter.start = 0;
        emitter.lifetime = scene.emitters.front().lifetime;
        emitter.rate = double(per_frame) / scene.time.step;
    }
    filled.limits.max_particles = 2 * per_frame * batches;
    return filled;
}

PaperRun run_fountain(const SimulationSettings& scene, std::size_t droplets, const PaperPlan& plan,
                      const Clock& clock, const Announce& announce)
{
    const SimulationSettings filled = filled_fountain(scene, droplets);
    const std::size_t lifetime = lifetime_frames(filled);
    const auto per_frame = std::size_t(filled.emitters.front().rate * filled.time.step + 0.5);
    const int settle = plan.settle_frames + int(lifetime);
    const ParticleSet dry;
    SimulationSettings bare = filled;
    bare.regions.clear();
    const Runner runner(filled, dry, plan, settle, clock, announce);
    PlainDroplets plain(filled);
    FlatFountain flat(filled, per_frame, lifetime, simd::kernels().name);
    PaperRun run{.name = "fountain of " + std::to_string(per_frame * lifetime * filled.emitters.size()) +
                         " droplets",
                 .baselines = {},
                 .clustered = {}};
    run.baselines = {runner.baseline("plain loop over droplets", settle, [&] { plain.step(); }),
                     runner.unclustered("each droplet by itself", bare),
                     runner.baseline("loop in whole registers", settle, [&] { flat.step(); })};
    run.clustered = runner.clustered();
    return run;
}

} // namespace slod::cost
