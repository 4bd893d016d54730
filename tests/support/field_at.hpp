#pragma once

#include "effects/fields/field.hpp"

namespace slod::test {

/// What one element of an effect of place comes to there, at time 0.
template <PlaceField F>
FieldValue field_at(const typename F::Settings& settings, const Vector3d& x)
{
    FieldValue sum;
    F(settings, FieldSource{}).add(x, 0, sum);
    return sum;
}

/// Of values near 1: some ten roundings.
inline constexpr double field_tolerance = 16 * 0x1p-52;

} // namespace slod::test
