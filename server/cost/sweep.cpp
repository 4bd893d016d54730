#include "cost/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "cost/metrics.hpp"

namespace slod::cost {
namespace {

/// A cloud with what is asked of it again and again.
struct Cloud {
    explicit Cloud(ParticleSet set)
        : particles(std::move(set)), x(positions(particles)), v(velocities(particles))
    {}

    ParticleSet particles;
    Points x, v;
};

/// As many particles, drawn with replacement.
ParticleSet resample(const ParticleSet& particles, std::uint32_t draw)
{
    ParticleSet sample;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        Random random(1, draw, i);
        sample.push_back(particles[std::size_t(random.uniform() * double(particles.size()))]);
    }
    return sample;
}

Floor distances(const Cloud& a, const Cloud& b, double radius)
{
    return {.position = sliced_wasserstein(a.x, b.x),
            .velocity = sliced_wasserstein(a.v, b.v),
            .coarse = density_distance(a.x, b.x, radius / 4),
            .fine = density_distance(a.x, b.x, radius / 16)};
}

double over(double distance, double floor)
{
    return distance == 0 ? 0 : distance / floor;
}

double ratio(double a, double b)
{
    return b > 0 ? a / b : 1;
}

class Sweeper {
public:
    Sweeper(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
            const Clock& clock, const Progress& progress)
        : scene_(scene), initial_(initial), plan_(plan), clock_(clock), progress_(progress),
          particles_(initial(scene.seed)), runs_(double(1 + plan.seeds) + double(plan.settings.size()))
    {}

    Sweep run()
    {
        const Trial fine = trial({.max_cluster_size = 1}, scene_.seed, "unclustered");
        const Cloud reference(fine.particles);
        const double radius = std::max(rms_radius(reference.x), 1e-30);
        Sweep sweep{.rows = {}, .floor = measure_floor(reference, radius)};
        sweep.rows.push_back(row({.max_cluster_size = 1}, fine, reference, sweep.floor));
        for (const Setting& setting : plan_.settings)
            sweep.rows.push_back(
                row(setting, trial(setting, scene_.seed, setting.name()), reference, sweep.floor));
        return sweep;
    }

private:
    Trial trial(const Setting& setting, std::uint64_t seed, const std::string& name)
    {
        SimulationSettings settings = with_setting(scene_, setting);
        settings.seed = seed;
        const auto tell = [&](int frame) { progress_(name, (done_ + double(frame) / plan_.frames) / runs_); };
        const bool own = seed == scene_.seed;
        Trial outcome = run_trial(settings, own ? particles_ : initial_(seed), plan_.frames, clock_, tell);
        done_ += 1;
        return outcome;
    }

    Floor measure_floor(const Cloud& reference, double radius)
    {
        Floor sum{.rms_radius = radius};
        for (int k = 1; k <= plan_.seeds; ++k) {
            const std::uint64_t seed = scene_.seed + std::uint64_t(k);
            Cloud other(sum.resampled ? ParticleSet()
                                      : trial({.max_cluster_size = 1}, seed,
                                              "unclustered, seed " + std::to_string(seed))
                                            .particles);
            Floor apart = distances(reference, other, radius);
            if (sum.resampled || apart.position == 0) { // no random number is in it
                sum.resampled = true;
                apart = distances(reference, Cloud(resample(reference.particles, std::uint32_t(k))), radius);
            }
            sum.position += apart.position / plan_.seeds;
            sum.velocity += apart.velocity / plan_.seeds;
            sum.coarse += apart.coarse / plan_.seeds;
            sum.fine += apart.fine / plan_.seeds;
        }
        done_ = double(1 + plan_.seeds);
        return sum;
    }

    Row row(const Setting& setting, const Trial& trial, const Cloud& reference, const Floor& floor) const
    {
        const Cloud cloud(trial.particles);
        const Floor apart = distances(reference, cloud, floor.rms_radius);
        const auto radius = [&](double share) {
            return ratio(lagrangian_radius(cloud.x, share), lagrangian_radius(reference.x, share));
        };
        return {.setting = setting,
                .ms_median = trial.ms_median,
                .ms_p10 = trial.ms_p10,
                .ms_p90 = trial.ms_p90,
                .clusters = trial.clusters,
                .errors = {.position = over(apart.position, floor.position),
                           .velocity = over(apart.velocity, floor.velocity),
                           .coarse = over(apart.coarse, floor.coarse),
                           .fine = over(apart.fine, floor.fine)},
                .median_displacement =
                    median_displacement(reference.particles, cloud.particles) / floor.rms_radius,
                .r10 = radius(0.1),
                .r50 = radius(0.5),
                .r90 = radius(0.9),
                .momentum_drift = trial.momentum_drift,
                .energy_change = trial.energy_change};
    }

    const SimulationSettings& scene_;
    const Initial& initial_;
    const SweepPlan& plan_;
    const Clock& clock_;
    const Progress& progress_;
    const ParticleSet particles_; ///< at the start, for the scene's own seed
    double runs_;                 ///< in the plan
    double done_ = 0;             ///< of them
};

} // namespace

SweepPlan SweepPlan::full()
{
    SweepPlan plan;
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid})
        for (double size = 2; size <= 256; size *= 2)
            plan.settings.push_back({motion, size});
    return plan;
}

SweepPlan SweepPlan::quick()
{
    SweepPlan plan{.settings = {}, .frames = 100, .seeds = 2};
    for (const Motion motion : {Motion::Flow, Motion::Rigid})
        for (const double size : {4.0, 16.0, 64.0})
            plan.settings.push_back({motion, size});
    return plan;
}

double Errors::largest() const
{
    return std::max({position, velocity, coarse, fine});
}

Sweep run_sweep(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
                const Clock& clock, const Progress& progress)
{
    return Sweeper(scene, initial, plan, clock, progress).run();
}

} // namespace slod::cost
