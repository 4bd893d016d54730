#pragma once

#include <array>
#include <cmath>

#include "core/portable_math.hpp"
#include "core/random.hpp"
#include "core/vectors.hpp"

namespace slod {

/// Normally distributed, mean 0 and variance 1. Marsaglia's polar method: no sine or cosine.
inline double random_normal(Random& random)
{
    for (;;) {
        const double u = 2 * random.uniform() - 1;
        const double v = 2 * random.uniform() - 1;
        const double s = u * u + v * v;
        if (s > 0 && s < 1)
            return u * std::sqrt(-2 * portable_log(s) / s);
    }
}

/// Uniform on the unit sphere.
inline Vector3d random_direction(Random& random)
{
    for (;;) {
        const double x = 2 * random.uniform() - 1;
        const double y = 2 * random.uniform() - 1;
        const double z = 2 * random.uniform() - 1;
        const double r2 = x * x + y * y + z * z;
        if (r2 > 1e-6 && r2 <= 1) {
            const double scale = 1 / std::sqrt(r2);
            return {x * scale, y * scale, z * scale};
        }
    }
}

/// Uniform in the unit disc.
inline std::array<double, 2> random_point_in_disc(Random& random)
{
    for (;;) {
        const double x = 2 * random.uniform() - 1;
        const double y = 2 * random.uniform() - 1;
        if (x * x + y * y <= 1)
            return {x, y};
    }
}

} // namespace slod
