#pragma once

#include <cmath>

namespace slod {

/// The smallest power of two above a positive number; 1 of anything else.
inline double power_of_two_above(double value)
{
    return value > 0 && std::isfinite(value) ? std::ldexp(1.0, std::ilogb(value) + 1) : 1.0;
}

} // namespace slod
