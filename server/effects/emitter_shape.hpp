#pragma once

#include <cstddef>

#include "core/assert.hpp"
#include "effects/emitter_settings.hpp"

namespace slod {

/// Orthonormal.
struct EmitterAxes {
    Vector3d forward, side, other_side;
};

/// Random numbers of one particle, in (0, 1), that have been drawn beforehand.
class DrawnNumbers {
public:
    /// So many, `stride` apart.
    DrawnNumbers(const double* first, std::size_t stride, std::size_t count)
        : next_(first), stride_(stride), left_(count)
    {}

    double uniform()
    {
        SLOD_ASSERT(left_ > 0);
        --left_;
        const double number = *next_;
        next_ += stride_;
        return number;
    }

private:
    const double* next_;
    std::size_t stride_, left_;
};

/// A shape that particles start from. `draw` gives the offset of one from the shape's centre, distributed
/// evenly, by `numbers` random numbers at most.
struct EmitterShapeKind {
    using Draw = Vector3d (*)(const EmitterSettings&, const EmitterAxes&, DrawnNumbers);

    static constexpr std::size_t most_numbers = 4; ///< of all kinds

    Draw draw;
    std::size_t numbers = 0;
    // Which keys say how large it is.
    bool radius = false, inner_radius = false, half_extent = false, fill = false;
};

const EmitterShapeKind& kind_of(EmitterShape shape);

/// What is wrong with the keys of the settings' shape, those of other shapes among them.
Problems shape_problems(const EmitterSettings& settings);

} // namespace slod
