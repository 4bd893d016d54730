#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/one_cluster.hpp"

// What goes with the air of eddies, which have no divergence, is as dense everywhere as it was.
namespace slod::test {
namespace {

constexpr int cells = 4; ///< along each side of the inner cube, each as long as an eddy

/// Of the shares of the inner cells from equal ones, in units of what it is for particles placed at random:
/// each of n has a mean deviation of sqrt(2 n / pi).
double total_variation(const ParticleSet& particles)
{
    std::array<double, cells * cells * cells> counts{};
    double inside = 0;
    for (const Particle& particle : particles) {
        const Vector3d x = particle.position.array() + 0.5 * cells;
        if ((x.array() < 0).any() || (x.array() >= cells).any())
            continue;
        const Eigen::Vector3i cell = x.cast<int>();
        ++counts[std::size_t((cell.x() * cells + cell.y()) * cells + cell.z())];
        ++inside;
    }
    const double mean = inside / double(counts.size());
    double variation = 0;
    for (const double count : counts)
        variation += 0.5 * std::abs(count - mean) / inside;
    return variation / std::sqrt(1 / (2 * std::numbers::pi * mean));
}

// In 3 turnover times a tracer goes 1.3 eddies far, 0.8 along each axis, which mixes what is within an eddy;
// of those that would be at the inner cube's faces one in a hundred would have come from beyond the outer
// cube, 2 eddies off, and few of those farther in. The deviation of 64 cells' total scatters by sqrt(pi / 2 -
// 1) / 8, 9 %.
TEST(Tracers, F07_StayUniformForTenThousandSteps)
{
    constexpr int frames = 10'000;
    SimulationSettings settings = settings_for({});
    settings.background.max_cluster_size = 1;
    settings.background.max_breadth = 1;
    settings.time.step = 3.0 / frames;
    settings.linear_drag = LinearDragSettings{30 / settings.time.step};
    settings.fields.of<Turbulence>() =
        TurbulenceSettings{.amplitude = 1, .length = 1, .octaves = 1, .time = 3};
    const ParticleSet initial = cube(12'800, cells, 7);
    CaseCurve curve{.name = "12,800 tracers", .x = {}, .y = {}};
    double way = 0;
    ThreadTeam(2).run([&] {
        Simulation simulation(settings, initial, {});
        for (int frame = 0; frame <= frames; ++frame) {
            if (frame % 500 == 0) {
                curve.x.push_back(frame * settings.time.step);
                curve.y.push_back(total_variation(simulation.particles()));
            }
            simulation.step({});
        }
        const ParticleSet now = simulation.particles();
        for (std::size_t i = 0; i < now.size(); ++i)
            way += (now[i].position - initial[i].position).norm() / double(now.size());
    });
    report_value("variation at the start, of that of random places", curve.y.front());
    expect_at_most("variation at the end, of that of random places", curve.y.back(), 1.2);
    expect_at_least("mean way, eddies", way, 0.5);
    report_picture({.title = "Tracers in eddies: deviation from an even density",
                    .x_axis = "time, turnovers",
                    .y_axis = "of that of random places",
                    .curves = {curve}});
}

} // namespace
} // namespace slod::test
