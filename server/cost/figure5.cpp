#include "cost/figure5.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/assert.hpp"

namespace slod::cost {
namespace {

/// Slope of the logarithm of the factors over that of the sizes, by least squares.
double exponent(const std::array<double, 4>& sizes, const std::array<double, 4>& factors)
{
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double size = std::log(sizes[i]), factor = std::log(factors[i]);
        x += size;
        y += factor;
        xx += size * size;
        xy += size * factor;
    }
    const auto count = double(sizes.size());
    return (count * xy - x * y) / (count * xx - x * x);
}

std::vector<Clustered> of_motion(const PaperRun& run, Motion motion)
{
    std::vector<Clustered> own;
    for (const Clustered& clustered : run.clustered)
        if (clustered.motion == motion)
            own.push_back(clustered);
    return own;
}

/// The least size from which on all are at least as fast.
std::optional<double> break_even(const std::vector<Clustered>& own, double baseline_ms)
{
    std::optional<double> least;
    for (auto clustered = own.rbegin(); clustered != own.rend() && clustered->ms <= baseline_ms; ++clustered)
        least = clustered->size;
    return least;
}

SpeedUps::Over over(const std::vector<Clustered>& own, const Baseline& baseline, const PaperFigures& paper)
{
    SpeedUps::Over found{.at_least = true};
    for (std::size_t i = 0; i < paper.sizes.size(); ++i) {
        const auto at = std::find_if(own.begin(), own.end(), [&](const Clustered& clustered) {
            return clustered.size == paper.sizes[i];
        });
        SLOD_ASSERT(at != own.end());
        found.factors[i] = baseline.ms / at->ms;
        found.at_least = found.at_least && found.factors[i] >= paper.factors[i];
    }
    found.break_even = break_even(own, baseline.ms);
    found.in_time =
        !paper.break_even || found.break_even.value_or(*paper.break_even + 1) <= *paper.break_even;
    return found;
}

SpeedUps speed_ups_of(const std::vector<Clustered>& own, const PaperRun& run, const PaperFigures& paper)
{
    SpeedUps found{.motion = own.front().motion};
    for (const Baseline& baseline : run.baselines)
        found.over.push_back(over(own, baseline, paper));
    found.exponent = exponent(paper.sizes, found.over.front().factors);
    found.exponent_holds = found.exponent >= paper.least_exponent && found.exponent <= paper.most_exponent;
    return found;
}

} // namespace

const PaperFigures paper_fountain{
    .factors = {1.79, 3.07, 6.33, 10.53}, .break_even = 6, .least_exponent = 0.7, .most_exponent = 1.05};
const PaperFigures paper_galaxy{.factors = {14.28, 45.94, 122.78, 295.67},
                                .least_exponent = 1.2,
                                .most_exponent = std::numeric_limits<double>::infinity()};

std::vector<SpeedUps> speed_ups(const PaperRun& run, const PaperFigures& paper)
{
    SLOD_ASSERT(!run.baselines.empty());
    std::vector<SpeedUps> all;
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid})
        if (const std::vector<Clustered> own = of_motion(run, motion); !own.empty())
            all.push_back(speed_ups_of(own, run, paper));
    return all;
}

Phase longest_phase(const StepProfile& phases)
{
    const auto& ms = phases.milliseconds;
    return Phase(std::max_element(ms.begin(), ms.end()) - ms.begin());
}

} // namespace slod::cost
