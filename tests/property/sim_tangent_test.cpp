#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/pair_error.hpp"
#include "support/small_scenes.hpp"

// A cluster's flow map is the tangent of the code's own step. Two particles at +-delta about a cluster's
// centre, in position and velocity, are carried by the map in one simulation and move freely in another, in
// the field of heavy bodies that are alone in their clusters in both. What differs is of second order in
// delta: its even part, the centre's own, is O(delta^2), and its odd part, the map's, O(delta^3). A term
// missing from a map leaves an odd part of first order.
namespace slod::test {
namespace {

constexpr std::uint32_t life = 64; ///< frames: longer than any run here
constexpr double widest = 0.125;   ///< delta of the coarsest run; halved from run to run
constexpr std::array run_frames{8, 16, 32};
constexpr double wide_softening = 1.2; ///< where the members attract each other
constexpr double float_rounding = 0x1p-24;

/// One scene's effects and the pair's mass.
struct TangentPlan {
    const char* name;
    std::function<void(SimulationSettings&)> choose;
    float pair_mass = 0;

    friend std::ostream& operator<<(std::ostream& out, const TangentPlan& plan) { return out << plan.name; }
};

void attract(SimulationSettings& settings)
{
    settings.gravity.emplace();
    settings.gravity->precision = Precision::Double;
    settings.gravity->size_softening = 0;
    settings.gravity->closure = false;
}

void fall(SimulationSettings& settings)
{
    settings.uniform_gravity = UniformGravitySettings{{0.3, 0.2, -0.5}};
}

void drag(SimulationSettings& settings)
{
    settings.linear_drag = LinearDragSettings{1.5};
}

void blow(SimulationSettings& settings)
{
    drag(settings);
    settings.uniform_wind = UniformWindSettings{{0.4, -0.3, 0.2}};
}

void soften(SimulationSettings& settings)
{
    attract(settings);
    settings.gravity->size_softening = 0.1;
}

/// In a pair much closer than its softening the members attract each other as a homogeneous ball does.
void close(SimulationSettings& settings)
{
    attract(settings);
    settings.gravity->closure = true;
    settings.kinds.front().softening = wide_softening;
}

void rigid(SimulationSettings& settings)
{
    settings.motion.motion = Motion::Rigid;
}

void stream(SimulationSettings& settings)
{
    settings.motion.motion = Motion::Stream;
}

template <auto first, auto second>
void both(SimulationSettings& settings)
{
    first(settings);
    second(settings);
}

void everything(SimulationSettings& settings)
{
    close(settings);
    fall(settings);
    blow(settings);
}

/// Settings under which the pair stays one cluster and every heavy body one of its own: cells of side 1, one
/// body or pair in each.
SimulationSettings settings_of(const TangentPlan& plan, double max_cluster_size)
{
    SimulationSettings settings = quiet_settings();
    settings.motion.shortest_life = settings.motion.longest_life = life;
    settings.background.max_cluster_size = max_cluster_size;
    settings.background.max_breadth = 1;
    plan.choose(settings);
    return settings;
}

/// The pair first, then four heavy bodies at distances from 2 to 3.
ParticleSet particles_of(const TangentPlan& plan, double delta)
{
    const Vector3d centre(0.5, 0.5, 0.5), velocity(0.2, -0.1, 0.15);
    const Vector3d offset(0.6, -0.64, 0.48), relative_velocity(-0.48, 0.6, 0.64); // of length 1
    ParticleSet particles;
    for (const double side : {delta, -delta})
        particles.push_back(
            {centre + side * offset, velocity + side * relative_velocity, particles.size(), plan.pair_mass});
    particles.push_back({{2.5, 0.7, 0.4}, {0.1, 0, 0}, 2, 6});
    particles.push_back({{0.3, -1.6, 1.5}, {0, 0.1, 0.1}, 3, 4});
    particles.push_back({{-1.5, 1.5, -0.5}, {0.1, 0.1, 0}, 4, 5});
    particles.push_back({{0.7, 0.6, 3.3}, {0, -0.1, 0}, 5, 7});
    return particles;
}

/// The errors after each of run_frames. Fails the test when the pair's cluster was formed anew meanwhile.
std::vector<PairError> errors_of(const TangentPlan& plan, double delta)
{
    const ParticleSet initial = particles_of(plan, delta);
    Simulation mapped(settings_of(plan, 8), initial, {});
    Simulation free(settings_of(plan, 1), initial, {});
    const std::vector<std::uint64_t> formations = mapped.snapshot({.clusters = true}).clusters.formation;
    EXPECT_EQ(formations.size(), initial.size() - 1) << "the pair is one cluster, the others are single";
    std::vector<PairError> errors;
    for (int frame = 1; frame <= run_frames.back(); ++frame) {
        mapped.step({});
        free.step({});
        if (frame == run_frames[errors.size()])
            errors.push_back(compare_pairs(mapped.particles(), free.particles()));
    }
    EXPECT_EQ(mapped.snapshot({.clusters = true}).clusters.formation, formations);
    return errors;
}

double slope(double coarse, double fine)
{
    return std::log2(coarse / fine);
}

/// How far the slope of a pair's error may be from its order, as the share of the next term of its expansion
/// in the coarser run, and that of rounding in the finer one. The n-th term of a body's pull is
/// (n + 1) (radius / distance)^n, and two terms up from n = 2 or 3 that is 5/3 (radius / distance)^2 at most.
/// The members' own attraction, distance 2 r between them, is (1 + 4 r^2 / eps^2)^(-3/2) in proportion where
/// the closure has (1 + 10/3 r^2 / eps^2)^(-3/2); the second term of the difference is 55/6 (r / eps)^2 of
/// the first. Rounding: once per frame and column of the map, of the spread.
double slope_tolerance(const TangentPlan& plan, const PairError& coarse, double fine_error)
{
    double next_term = 5.0 / 3.0 * std::pow(coarse.radius / coarse.nearest, 2);
    if (plan.pair_mass > 0)
        next_term = std::max(next_term, 55.0 / 6.0 * std::pow(coarse.radius / wide_softening, 2));
    const double rounding = run_frames.back() * float_rounding * coarse.spread / fine_error;
    return -std::log2(1 - next_term) + std::log2(1 + rounding);
}

class TangentOfTheStep : public testing::TestWithParam<TangentPlan> {};
class NotTangent : public testing::TestWithParam<TangentPlan> {};
class ExactMap : public testing::TestWithParam<TangentPlan> {};

std::string name_of(const testing::TestParamInfo<TangentPlan>& info)
{
    return info.param.name;
}

TEST_P(TangentOfTheStep, PairsAgreeWithTheMapToSecondOrder)
{
    std::array<std::vector<PairError>, 3> runs;
    for (std::size_t run = 0; run < runs.size(); ++run)
        runs[run] = errors_of(GetParam(), std::ldexp(widest, -int(run)));
    for (std::size_t at = 0; at < run_frames.size(); ++at) {
        SCOPED_TRACE("after " + std::to_string(run_frames[at]) + " frames");
        for (std::size_t run = 0; run + 1 < runs.size(); ++run) {
            const PairError& coarse = runs[run][at];
            const PairError& fine = runs[run + 1][at];
            EXPECT_NEAR(slope(coarse.even, fine.even), 2, slope_tolerance(GetParam(), coarse, fine.even));
            EXPECT_NEAR(slope(coarse.odd, fine.odd), 3, slope_tolerance(GetParam(), coarse, fine.odd));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Flow, TangentOfTheStep,
                         testing::Values(TangentPlan{"attracted", attract},
                                         TangentPlan{"attracted_softly", soften},
                                         TangentPlan{"attracting_itself", close, 0.5F},
                                         TangentPlan{"attracted_and_falling", both<attract, fall>},
                                         TangentPlan{"attracted_with_drag", both<attract, drag>},
                                         TangentPlan{"attracted_in_wind", both<attract, blow>},
                                         TangentPlan{"everything", everything, 0.5F}),
                         name_of);

TEST_P(NotTangent, ErrsToFirstOrder)
{
    const std::vector<PairError> coarse = errors_of(GetParam(), widest);
    const std::vector<PairError> fine = errors_of(GetParam(), 0.5 * widest);
    for (std::size_t at = 0; at < run_frames.size(); ++at) {
        SCOPED_TRACE("after " + std::to_string(run_frames[at]) + " frames");
        EXPECT_LT(slope(coarse[at].odd, fine[at].odd), 2) << "an odd error is of order 1 or 3";
    }
}

INSTANTIATE_TEST_SUITE_P(Motions, NotTangent,
                         testing::Values(TangentPlan{"rigid", both<attract, rigid>},
                                         TangentPlan{"stream", both<attract, stream>},
                                         TangentPlan{"without_closure", attract, 0.5F}),
                         name_of);

TEST_P(ExactMap, PairsAgreeWithTheMapToItsRounding)
{
    const double time = run_frames.back() * settings_of(GetParam(), 8).time.step;
    // One rounding to float of the offset and one of the relative velocity, which acts for `time` at most;
    // and 1e-14 of roundings to double, at coordinates below 4.
    const double tolerance = float_rounding * widest * (1 + time + 1) + 1e-14;
    for (const PairError& error : errors_of(GetParam(), widest))
        EXPECT_LE(error.even + error.odd, tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Linear, ExactMap,
    testing::Values(TangentPlan{"free", [](SimulationSettings&) {}}, TangentPlan{"falling", fall},
                    TangentPlan{"with_drag", drag}, TangentPlan{"in_wind", blow},
                    TangentPlan{"falling_in_wind", both<fall, blow>},
                    TangentPlan{"stream_falling_in_wind", both<both<fall, blow>, stream>}),
    name_of);

} // namespace
} // namespace slod::test
