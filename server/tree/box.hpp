#pragma once

#include "core/vectors.hpp"

namespace slod {

/// An axis-aligned box, half open: lower <= x < upper.
struct Box {
    Vector3d lower{0, 0, 0}, upper{0, 0, 0};

    bool contains(const Vector3d& x) const
    {
        return (x.array() >= lower.array()).all() && (x.array() < upper.array()).all();
    }
    Vector3d size() const { return upper - lower; }

    int longest_side() const
    {
        int axis = 0;
        size().maxCoeff(&axis);
        return axis;
    }
};

} // namespace slod
