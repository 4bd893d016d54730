// What the SLOD-tree costs: per cluster, per crossing, with a thousand regions of interest instead of ten,
// and with one particle per cluster instead of a plain loop over particles.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/aligned.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "effects/uniform_fields.hpp"
#include "sim/simulation.hpp"

namespace {

using namespace slod;
using Clock = std::chrono::steady_clock;

constexpr double side = 100; ///< of the cube that particles drift in
constexpr double speed = 3;  ///< along each axis
constexpr int rounds = 60;   ///< frames measured

double milliseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Particles uniform in the cube that drift together, each a little off the common velocity.
ParticleSet drifting(std::size_t count)
{
    ParticleSet particles(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(1, 0, i);
        Particle& particle = particles[i];
        for (int axis = 0; axis < 3; ++axis) {
            particle.position[axis] = side * (random.uniform() - 0.5);
            particle.velocity[axis] = speed * (1 + 0.02 * (2 * random.uniform() - 1));
        }
        particle.id = i + 1;
        particle.mass = 1;
    }
    return particles;
}

SimulationSettings settings(double max_cluster_size)
{
    SimulationSettings drift;
    drift.kinds.push_back({"dust", 0});
    drift.background.max_cluster_size = max_cluster_size;
    drift.background.max_breadth = max_cluster_size > 1 ? 8.0 : side;
    drift.uniform_gravity.emplace();
    drift.uniform_gravity->acceleration = {0, 0, -0.1};
    drift.linear_drag.emplace();
    return drift;
}

/// `count` spheres, placed at random, of a tenth of the cube in all.
std::vector<RegionOfInterest> spheres(std::size_t count)
{
    std::vector<RegionOfInterest> regions(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(2, 0, i);
        RegionOfInterest& region = regions[i];
        region.name = "r" + std::to_string(i);
        region.shape = Shape::Sphere;
        region.radius = 0.5 * side * std::cbrt(0.1 * 6 / 3.141592653589793 / double(count));
        for (double& coordinate : region.centre)
            coordinate = side * (random.uniform() - 0.5);
        region.partition = settings(8).background;
    }
    return regions;
}

Simulation::Options timed()
{
    return {.isa = {},
            .tick = [] { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }};
}

/// The median frame of a run.
struct Frame {
    double update_ms, step_ms;
    FrameCounts counts; ///< of all frames together
    double clusters;
};

class Run {
public:
    Run(const SimulationSettings& scene, std::size_t particles)
        : simulation_(scene, drifting(particles), timed())
    {
        for (int frame = 0; frame < 20; ++frame) // until what was formed at the start has settled
            simulation_.step({});
    }

    void frame()
    {
        const Clock::time_point start = Clock::now();
        const Snapshot& snapshot = simulation_.step({});
        steps_.push_back(milliseconds_since(start));
        updates_.push_back(snapshot.profile[Phase::Update]);
        for (const EventCount& event : event_counts)
            counts_.*event.count += snapshot.counts.*event.count;
        clusters_ = double(snapshot.counts.clusters);
    }

    Frame result() const { return {median(updates_), median(steps_), counts_, clusters_}; }

private:
    Simulation simulation_;
    std::vector<double> updates_, steps_;
    FrameCounts counts_;
    double clusters_ = 0;
};

/// What a program without clusters would do for the same particles in the same fields.
class FlatLoop {
public:
    FlatLoop(const SimulationSettings& scene, std::size_t particles)
        : step_(UniformFields(scene.uniform_gravity, scene.linear_drag, {}).over(scene.time.step))
    {
        for (const Particle& particle : drifting(particles)) {
            positions_.push_back(particle.position);
            velocities_.push_back(particle.velocity);
        }
    }

    void frame()
    {
        const Clock::time_point start = Clock::now();
        for_each_block(positions_.size(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                step_.apply(positions_[i], velocities_[i]);
        });
        steps_.push_back(milliseconds_since(start));
    }

    double result() const { return median(steps_); }

private:
    Propagator step_;
    AlignedVector<Vector3d> positions_, velocities_;
    std::vector<double> steps_;
};

nlohmann::ordered_json measure(std::size_t particles)
{
    SimulationSettings few = settings(16), many = settings(16);
    few.regions = spheres(10);
    many.regions = spheres(1000);
    Run plain(settings(16), particles), ten(few, particles), thousand(many, particles);
    Run singles(settings(1), particles);
    FlatLoop loop(settings(1), particles);
    for (int round = 0; round < rounds; ++round) { // by turns, so that what disturbs disturbs all
        plain.frame();
        ten.frame();
        thousand.frame();
        singles.frame();
        loop.frame();
    }
    const Frame base = plain.result(), with_ten = ten.result(), with_thousand = thousand.result();
    return {
        {"particles", particles},
        {"clusters", base.clusters},
        {"crossings_per_frame", double(base.counts.crossings) / rounds},
        {"splits_per_frame", double(base.counts.splits) / rounds},
        {"nodes_touched_per_crossing",
         double(base.counts.nodes_searched) / double(std::max<std::uint64_t>(base.counts.crossings, 1))},
        {"ns_per_cluster", 1e6 * base.update_ms / base.clusters},
        {"rois_10_ms", with_ten.update_ms},
        {"rois_1000_ms", with_thousand.update_ms},
        {"rois_10_clusters", with_ten.clusters},
        {"rois_1000_clusters", with_thousand.clusters},
        {"rois_1000_over_10", with_thousand.update_ms / with_ten.update_ms},
        {"k1_ms", singles.result().step_ms},
        {"flat_loop_ms", loop.result()},
        {"overhead_at_k1", singles.result().step_ms / loop.result()},
    };
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures the SLOD-tree on particles that drift through a cube.");
    bool as_json = false;
    std::size_t particles = 200'000;
    int threads = 1;
    app.add_flag("--json", as_json, "Print the figures as one JSON object on the last line, too.");
    app.add_option("--particles", particles, "Number of particles.");
    app.add_option("--threads", threads, "Number of threads.");
    CLI11_PARSE(app, argc, argv);

    nlohmann::ordered_json figures;
    ThreadTeam team(threads);
    team.run([&] { figures = measure(particles); });
    for (const auto& [name, value] : figures.items())
        std::printf("%-28s %.4g\n", name.c_str(), value.get<double>());
    if (as_json) {
        nlohmann::ordered_json report = {{"benchmark", "tree"}, {"threads", threads}};
        report.update(figures);
        std::printf("%s\n", report.dump().c_str());
    }
}
