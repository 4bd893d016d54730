#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/settings.hpp"

namespace slod {

enum class Precision : std::uint8_t {
    Mixed,  ///< pairs in float relative to a local origin, sums in double
    Double, ///< everything in double: the reference
};

constexpr std::array<std::string_view, 2> names(Precision)
{
    return {"mixed", "double"};
}

/// Self-gravity between clusters.
struct GravitySettings {
    double strength = 1;         ///< factor on Newton's constant
    double size_softening = 0.1; ///< c in e^2 = eps^2 + c (s_i + s_j), s the position variance
    bool closure = true;         ///< members attract each other as a homogeneous ball
    Precision precision = Precision::Mixed;

    friend bool operator==(const GravitySettings&, const GravitySettings&) = default;
};

template <class Visitor>
void for_each_field(GravitySettings& gravity, Visitor&& visit)
{
    visit(Field{"strength", "", "Factor on Newton's constant.", 0, 1e30}, gravity.strength);
    visit(Field{"size_softening", "",
                "Share of the clusters' position variances added to a pair's squared softening.", 0, 10},
          gravity.size_softening);
    visit(Field{"closure", "", "Members of a cluster attract each other as a homogeneous ball does."},
          gravity.closure);
    visit(Field{"precision", "", "Arithmetic of pair forces: float with double sums, or all double."},
          gravity.precision);
}

} // namespace slod
