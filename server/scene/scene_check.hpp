#pragma once

#include "scene/scene.hpp"

namespace slod {

/// What no single key's range can say is wrong with a scene, the key first, problems(scene.simulation)
/// included; empty when nothing is.
Problems problems(const Scene& scene);

} // namespace slod
