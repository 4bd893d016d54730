#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace slod {

/// The phases of one frame, in order. The only list: profile, statistics, logs and reports loop over it.
enum class Phase : std::uint8_t {
    Commands,
    OpenKick,
    Propagate,
    Expire,
    Emit,
    Update,
    Moments,
    Forces,
    CloseKick,
    Snapshot,
    Meter,
};

inline constexpr std::size_t phase_count = 11;

constexpr std::array<std::string_view, phase_count> names(Phase)
{
    return {"commands", "open_kick", "propagate",  "expire",   "emit", "update",
            "moments",  "forces",    "close_kick", "snapshot", "meter"};
}

/// Milliseconds of each phase in one frame; 0 for a phase that is not in the plan.
struct StepProfile {
    std::array<double, phase_count> milliseconds{};

    double& operator[](Phase phase) { return milliseconds[std::size_t(phase)]; }
    double operator[](Phase phase) const { return milliseconds[std::size_t(phase)]; }
    double total() const
    {
        double sum = 0;
        for (const double phase : milliseconds)
            sum += phase;
        return sum;
    }
};

} // namespace slod
