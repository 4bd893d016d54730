#pragma once

#include "core/random.hpp"
#include "effects/emitter_settings.hpp"

namespace slod {

/// Orthonormal.
struct EmitterAxes {
    Vector3d forward, side, other_side;
};

/// A shape that particles start from. `draw` gives the offset of one from the shape's centre, distributed
/// evenly; it depends on the settings and what it draws alone.
struct EmitterShapeKind {
    using Draw = Vector3d (*)(const EmitterSettings&, const EmitterAxes&, Random&);

    Draw draw;
    // Which keys say how large it is.
    bool radius = false, inner_radius = false, half_extent = false, fill = false;
};

const EmitterShapeKind& kind_of(EmitterShape shape);

/// What is wrong with the keys of the settings' shape, those of other shapes among them.
Problems shape_problems(const EmitterSettings& settings);

} // namespace slod
