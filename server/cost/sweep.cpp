#include "cost/sweep.hpp"

#include <algorithm>
#include <optional>

#include "cost/metrics.hpp"

namespace slod::cost {
namespace {

const Setting unclustered{.max_cluster_size = 1};

double ratio(double a, double b)
{
    return b > 0 ? a / b : 1;
}

/// As exact as it is worth to be. Random kicks are drawn by the step: with others it would be another seed.
Setting reference_setting(const SimulationSettings& scene)
{
    Setting setting = unclustered;
    setting.steps = scene.brownian ? 1 : reference_steps;
    if (scene.gravity) {
        const Opening opening = opening_of(*scene.gravity);
        setting.opening = std::max(*scene.gravity.*opening.value * opening.finer, opening.least);
    }
    return setting;
}

class Sweeper {
public:
    Sweeper(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
            const Clock& clock, const Progress& progress)
        : scene_(scene), initial_(initial), plan_(plan), clock_(clock), progress_(progress),
          particles_(initial(scene.seed)), isolated_(is_isolated(scene, particles_)),
          runs_(double(2 + plan.seeds) + double(plan.settings.size()))
    {}

    Sweep run()
    {
        measure_floor();
        add(unclustered);
        for (const Setting& setting : plan_.settings)
            add(setting);
        for (int round = 0; round < plan_.rounds; ++round) {
            const std::vector<Setting> settings = next_round(plan_, sweep_.rows, scene_, particles_);
            runs_ += double(settings.size());
            for (const Setting& setting : settings)
                add(setting);
        }
        return std::move(sweep_);
    }

private:
    Trial trial(const Setting& setting, std::uint64_t seed, const std::string& name, bool measures_error)
    {
        SimulationSettings settings = with_setting(scene_, setting);
        settings.seed = seed;
        const auto tell = [&](int frame) { progress_(name, (done_ + double(frame) / plan_.frames) / runs_); };
        const bool own = seed == scene_.seed;
        Trial outcome = run_trial(settings, own ? particles_ : initial_(seed),
                                  {plan_.frames, setting.steps, measures_error}, clock_, tell);
        done_ += 1;
        return outcome;
    }

    const Cloud& reference()
    {
        if (!reference_)
            reference_.emplace(trial(reference_setting(scene_), scene_.seed, "reference", false).particles);
        return *reference_;
    }

    /// The scene's own seed without clusters: the first row, and what other seeds are compared with.
    const Trial& unclustered_trial()
    {
        if (!unclustered_)
            unclustered_ = trial(unclustered, scene_.seed, unclustered.name(), true);
        return *unclustered_;
    }

    void measure_floor()
    {
        Floor& floor = sweep_.floor;
        const Cloud own(unclustered_trial().particles);
        floor.rms_radius = std::max(rms_radius(own.x), 1e-30);
        for (int k = 1; k <= plan_.seeds; ++k)
            floor += between_seeds(own, k) / plan_.seeds;
    }

    Distances between_seeds(const Cloud& own, int k)
    {
        Floor& floor = sweep_.floor;
        const std::uint64_t seed = scene_.seed + std::uint64_t(k);
        if (!floor.resampled) {
            const std::string name = "unclustered, seed " + std::to_string(seed);
            const Distances apart =
                distances(own, Cloud(trial(unclustered, seed, name, false).particles), floor.rms_radius);
            floor.resampled = apart.position == 0; // no random number is in it
            if (!floor.resampled)
                return apart;
        }
        return distances(own, Cloud(resample(own.particles, std::uint32_t(k))), floor.rms_radius);
    }

    void add(const Setting& setting)
    {
        Row row = measure(setting);
        row.errors = in_floors(row.apart, sweep_.floor);
        sweep_.rows.push_back(std::move(row));
    }

    Row measure(const Setting& setting)
    {
        const Cloud& wanted = reference();
        sweep_.particles = wanted.particles.size();
        const Trial run =
            setting == unclustered ? unclustered_trial() : trial(setting, scene_.seed, setting.name(), true);
        const Cloud cloud(run.particles);
        const auto radius = [&](double share) {
            return ratio(lagrangian_radius(cloud.x, share), lagrangian_radius(wanted.x, share));
        };
        const double rms = sweep_.floor.rms_radius;
        Row row{.setting = setting,
                .in_full = in_full(setting, scene_),
                .ms_median = run.ms_median,
                .ms_p10 = run.ms_p10,
                .ms_p90 = run.ms_p90,
                .clusters = double(run.clusters),
                .apart = distances(wanted, cloud, rms),
                .errors = {},
                .median_displacement = median_displacement(wanted.particles, cloud.particles) / rms,
                .r10 = radius(0.1),
                .r50 = radius(0.5),
                .r90 = radius(0.9),
                .force = run.force,
                .drifts = {},
                .phases = run.phases};
        if (isolated_)
            row.drifts = drifts(start(), totals(cloud.particles, scene_));
        return row;
    }

    const Totals& start()
    {
        if (!start_)
            start_ = totals(particles_, scene_);
        return *start_;
    }

    const SimulationSettings& scene_;
    const Initial& initial_;
    const SweepPlan& plan_;
    const Clock& clock_;
    const Progress& progress_;
    const ParticleSet particles_; ///< at the start, for the scene's own seed
    const bool isolated_;
    double runs_;     ///< in the plan, as far as it is known
    double done_ = 0; ///< of them
    std::optional<Cloud> reference_;
    std::optional<Trial> unclustered_;
    std::optional<Totals> start_; ///< of the particles
    Sweep sweep_;
};

} // namespace

Sweep run_sweep(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
                const Clock& clock, const Progress& progress)
{
    return Sweeper(scene, initial, plan, clock, progress).run();
}

} // namespace slod::cost
