#pragma once

#include "scene/scene.hpp"

namespace slod {

/// What no single key's range can say is wrong with a scene, the key first, problems(scene.simulation)
/// included; empty when nothing is.
Problems problems(const Scene& scene);

/// Limits of what the scene does not conserve, or what is not measured of it; empty when there are none.
Problems problems(const AlarmSettings& alarms, const SimulationSettings& simulation);

} // namespace slod
