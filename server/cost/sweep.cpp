#include "cost/sweep.hpp"

#include <algorithm>
#include <limits>
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

/// The numbers by their names; what is not known is null.
template <class Outcome>
FinishedRuns::Json numbers_of(const Outcome& outcome)
{
    FinishedRuns::Json json;
    for_each_number(outcome, [&](const std::string& name, const auto& number) { json[name] = number; });
    return json;
}

/// What numbers_of() wrote; none where it is anything else.
template <class Outcome>
std::optional<Outcome> read_numbers(const FinishedRuns::Json& json)
{
    Outcome outcome;
    bool complete = true;
    for_each_number(outcome, [&]<class Number>(const std::string& name, Number& number) {
        const auto found = json.find(name);
        complete = complete && found != json.end() && (found->is_primitive() && !found->is_string());
        if (complete)
            number =
                found->is_null() ? Number(std::numeric_limits<double>::quiet_NaN()) : found->get<Number>();
    });
    return complete ? std::optional(outcome) : std::nullopt;
}

class Sweeper {
public:
    Sweeper(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
            const Clock& clock, const Progress& progress, FinishedRuns& finished)
        : scene_(scene), initial_(initial), plan_(plan), clock_(clock), progress_(progress),
          finished_(finished), particles_(initial(scene.seed)), isolated_(is_isolated(scene, particles_)),
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

    const Cloud& own()
    {
        if (!own_)
            own_.emplace(unclustered_trial().particles);
        return *own_;
    }

    void measure_floor()
    {
        Floor& floor = sweep_.floor;
        for (int k = 1; k <= plan_.seeds; ++k) {
            const std::string run = "seed " + std::to_string(k);
            std::optional<Floor> apart = recall<Floor>(run);
            if (!apart) {
                apart = between_seeds(k);
                remember(run, *apart);
            }
            floor += *apart / plan_.seeds;
            floor.rms_radius = apart->rms_radius;
            floor.resampled = apart->resampled;
        }
    }

    Floor between_seeds(int k)
    {
        Floor apart;
        apart.rms_radius = std::max(rms_radius(own().x), 1e-30);
        apart.resampled = sweep_.floor.resampled;
        const auto measure = [&](ParticleSet other) {
            static_cast<Distances&>(apart) = distances(own(), Cloud(std::move(other)), apart.rms_radius);
        };
        if (!apart.resampled) {
            const std::uint64_t seed = scene_.seed + std::uint64_t(k);
            measure(trial(unclustered, seed, "unclustered, seed " + std::to_string(seed), false).particles);
            apart.resampled = apart.position == 0; // no random number is in it
        } else
            done_ += 1;
        if (apart.resampled)
            measure(resample(own().particles, std::uint32_t(k)));
        return apart;
    }

    void add(const Setting& setting)
    {
        const Setting full = in_full(setting, scene_);
        std::optional<Row> row = recall<Row>(full.name());
        sweep_.runs += 1;
        sweep_.known += row ? 1 : 0;
        if (!row) {
            row = measure(setting);
            remember(full.name(), *row);
        }
        row->setting = setting;
        row->in_full = full;
        row->errors = in_floors(row->apart, sweep_.floor);
        sweep_.rows.push_back(std::move(*row));
    }

    template <class Outcome>
    std::optional<Outcome> recall(const std::string& run)
    {
        const FinishedRuns::Json* const known = finished_.find(run);
        std::optional<Outcome> outcome;
        if (known != nullptr)
            outcome = read_numbers<Outcome>(*known);
        runs_ -= outcome ? 1 : 0;
        return outcome;
    }

    template <class Outcome>
    void remember(const std::string& run, const Outcome& outcome)
    {
        finished_.add(run, numbers_of(outcome));
    }

    Row measure(const Setting& setting)
    {
        const Cloud& wanted = reference();
        const Trial run =
            setting == unclustered ? unclustered_trial() : trial(setting, scene_.seed, setting.name(), true);
        const Cloud cloud(run.particles);
        const auto radius = [&](double share) {
            return ratio(lagrangian_radius(cloud.x, share), lagrangian_radius(wanted.x, share));
        };
        const double rms = sweep_.floor.rms_radius;
        Row row{.setting = {},
                .in_full = {},
                .ms_median = run.ms_median,
                .ms_p10 = run.ms_p10,
                .ms_p90 = run.ms_p90,
                .particles = double(run.particles.size()),
                .clusters = double(run.clusters),
                .apart = distances(wanted, cloud, rms),
                .errors = {},
                .median_displacement = median_displacement(wanted.particles, cloud.particles) / rms,
                .r10 = radius(0.1),
                .r50 = radius(0.5),
                .r90 = radius(0.9),
                .thickness = ratio(thickness(cloud.x), thickness(wanted.x)),
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
    FinishedRuns& finished_;
    const ParticleSet particles_; ///< at the start, for the scene's own seed
    const bool isolated_;
    double runs_;     ///< to be made, as far as the plan is known
    double done_ = 0; ///< of them
    std::optional<Cloud> reference_;
    std::optional<Trial> unclustered_;
    std::optional<Cloud> own_;    ///< at the end of that
    std::optional<Totals> start_; ///< of the particles
    Sweep sweep_;
};

} // namespace

Sweep run_sweep(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
                const Clock& clock, const Progress& progress, FinishedRuns& finished)
{
    return Sweeper(scene, initial, plan, clock, progress, finished).run();
}

} // namespace slod::cost
