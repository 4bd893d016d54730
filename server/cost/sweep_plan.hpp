#pragma once

#include <vector>

#include "cost/row.hpp"

namespace slod::cost {

/// What is run, and for how long. First the settings, all motions at all sizes. Then, in rounds, points of
/// each motion's front, at each of which one value after the other is changed: what all combinations would
/// find in thousands of runs, this finds in some dozens where values act on their own, and a second round,
/// which begins at the points that the first has found, where they do not.
struct SweepPlan {
    std::vector<Setting> settings{}; ///< of the first part; the unclustered one apart
    int frames = 300;
    int seeds = 5; ///< unclustered runs that say how far two runs are that nobody could tell apart
    int rounds = 2;
    int points = 2;                              ///< of each motion's front, in each round
    std::vector<double> clocks{0.25, 0.5, 2, 4}; ///< to be tried, as factors of the setting's
    std::vector<std::uint32_t> steps{1, 2};      ///< of a frame, to be tried

    /// All motions at sizes from 2 to 256, or a few of them over fewer frames.
    static SweepPlan full();
    static SweepPlan quick();
};

/// The reference has its frames in so many steps, more than any setting.
inline constexpr std::uint32_t reference_steps = 4;

/// The settings of the next round: those that differ in one value from a point of a front, and that no row
/// has. Opening and precision where gravity has them to decide on, the clock where `clocked` says that maps
/// are renewed by it.
std::vector<Setting> next_round(const SweepPlan& plan, const std::vector<Row>& rows,
                                const SimulationSettings& scene, const ParticleSet& initial);

} // namespace slod::cost
