#pragma once

#include "tree/box.hpp"

namespace slod {

/// All within a margin of a straight way.
class Sweep {
public:
    /// `margin` along each axis.
    Sweep(const Vector3d& from, const Vector3d& to, const Vector3d& margin);

    /// A box around it.
    const Box& bounds() const { return bounds_; }

    /// Whether it may have a point in common with the box. Never false falsely, up to rounding.
    bool meets(const Box& box) const;

private:
    Vector3d from_, margin_, inverse_; ///< 1 / way, infinite along axes that it does not follow
    Box bounds_;
};

} // namespace slod
