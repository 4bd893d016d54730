#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/settings.hpp"

namespace slod::cost {

/// One way to run the scene. What is absent is as the scene has it.
struct Setting {
    Motion motion = Motion::Flow;
    double max_cluster_size = 1;          ///< of the background; regions keep their proportion to it
    std::optional<double> clock{};        ///< share of the tidal time after which maps are renewed
    std::optional<double> opening{};      ///< of gravity's walks: what opening_of() names
    std::uint32_t steps = 1;              ///< that the time of one of the scene's frames is cut into
    std::optional<Precision> precision{}; ///< of gravity's pairs

    /// All that it says: "unclustered", "flow 16", "rigid 4, clock 0.1, 2 steps".
    std::string name() const;
    bool unclustered() const { return max_cluster_size < 2; }

    friend bool operator==(const Setting&, const Setting&) = default;
};

/// What decides how accurate gravity's walks are, by the scene's own criterion: accuracy where it is given,
/// else opening_angle or force_tolerance.
struct Opening {
    const char* key;
    double GravitySettings::*value;
    double least, most;    ///< that can be asked for
    double finer, coarser; ///< factors that make a clear difference
};
Opening opening_of(const GravitySettings& gravity);

/// The scene's simulation with this setting.
SimulationSettings with_setting(const SimulationSettings& scene, const Setting& setting);

/// The setting with what is absent filled in from the scene, but for what the scene has not: opening and
/// precision without gravity.
Setting in_full(const Setting& setting, const SimulationSettings& scene);

} // namespace slod::cost
