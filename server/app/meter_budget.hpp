#pragma once

#include <cstdint>

#include "scene/server_settings.hpp"

namespace slod {

/// How much the error meter may do, so that it takes its share of the frames' time and no more in the long
/// run: what a frame overdraws, later ones go without. Knows no clock: it is told what frames took.
class MeterBudget {
public:
    /// Pairs that the next frame may sum up; 0: none, the share is used up or the meter switched off.
    std::uint64_t pairs(const MeterSettings& settings) const;

    /// Takes in a frame: its time, the meter's part of it, and the pairs that were summed up. Times in ms.
    void add(const MeterSettings& settings, double frame_ms, double meter_ms, std::uint64_t pairs);

private:
    double credit_ms_ = 0;
    double pairs_per_ms_ = 2e5; ///< the best of late; what a slow core does, to begin with
};

} // namespace slod
