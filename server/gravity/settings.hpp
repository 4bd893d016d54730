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

/// When a node of the tree may act as one body.
enum class OpeningCriterion : std::uint8_t {
    Relative,  ///< its error is small beside the acceleration that the target last felt
    Geometric, ///< it is small beside its distance
};

constexpr std::array<std::string_view, 2> names(OpeningCriterion)
{
    return {"relative", "geometric"};
}

/// Largest opening angle there is: a node is never opened by less than nine tenths of its distance.
inline constexpr double widest_opening = 0.9;

/// What a node that acts as one body is made of.
enum class Multipoles : std::uint8_t {
    Monopole,   ///< its mass
    Quadrupole, ///< its second moments too
};

constexpr std::array<std::string_view, 2> names(Multipoles)
{
    return {"monopole", "quadrupole"};
}

/// Range of the median errors that can be asked for: that of the calibration.
inline constexpr double least_accuracy = 1.9e-5, most_accuracy = 4e-3;

/// Self-gravity between clusters.
struct GravitySettings {
    double strength = 1;         ///< factor on Newton's constant
    double accuracy = 0;         ///< median relative error to aim at: with_accuracy(); 0: none
    double size_softening = 0.1; ///< c in e^2 = eps^2 + c (s_i + s_j), s the position variance
    bool closure = true;         ///< members attract each other as a homogeneous ball
    Precision precision = Precision::Mixed;
    OpeningCriterion opening = OpeningCriterion::Relative;
    Multipoles multipoles = Multipoles::Quadrupole;
    double opening_angle = 0.5;     ///< radius over distance, of the geometric criterion
    double force_tolerance = 0.001; ///< of the relative criterion
    /// Acting bodies below which all pairs are summed, which is exact and never more than 5 ms. One thread,
    /// with tides, ms of the sum and of the walk, for 1000, 1500, 2000, 2500, 3000 and 4000 bodies: in a
    /// Plummer sphere 0.6 0.7, 1.3 1.3, 2.2 1.9, 3.5 2.4, 5.2 3.1, 8.9 4.4; in a disc 0.6 0.5, 1.3
    /// 0.8, 2.2 1.2, 3.5 1.6, 5.0 1.9, 8.3 2.6.
    std::uint32_t direct_below = 3000;

    friend bool operator==(const GravitySettings&, const GravitySettings&) = default;
};

/// What accuracy chooses, if it is given: everything else as it is.
GravitySettings with_accuracy(const GravitySettings& asked);

/// What is wrong with the settings together, each with the key in front; empty when nothing is.
Problems problems(const GravitySettings& gravity);

template <class Visitor>
void for_each_field(GravitySettings& gravity, Visitor&& visit)
{
    visit(Field{"strength", "", "Factor on Newton's constant.", 0, 1e30}, gravity.strength);
    visit(Field{"accuracy", "",
                "Median relative error of the forces to aim at, at least 1.9e-5, by which the criterion, "
                "what nodes "
                "are made of and their tolerance are chosen; 0: as they are set.",
                0, most_accuracy},
          gravity.accuracy);
    visit(Field{"size_softening", "",
                "Share of the clusters' position variances added to a pair's squared softening.", 0, 10},
          gravity.size_softening);
    visit(Field{"closure", "", "Members of a cluster attract each other as a homogeneous ball does."},
          gravity.closure);
    visit(Field{"precision", "", "Arithmetic of pair forces: float with double sums, or all double."},
          gravity.precision);
    visit(Field{"opening", "",
                "When a node of the tree acts as one body: by its error beside the last acceleration, or by "
                "its angle."},
          gravity.opening);
    visit(Field{"multipoles", "",
                "What a node that acts as one body is: its mass, or where that misses too much its second "
                "moments as well."},
          gravity.multipoles);
    visit(Field{"opening_angle", "",
                "A node acts as one body when its radius is below this share of its distance: the geometric "
                "criterion, and the relative one's where no acceleration is known yet.",
                0, widest_opening},
          gravity.opening_angle);
    visit(Field{"force_tolerance", "",
                "A node acts as one body when its error is below this share of the last acceleration: the "
                "relative criterion.",
                0, 1},
          gravity.force_tolerance);
    visit(Field{"direct_below", "clusters", "Below so many that act, all pairs are summed instead.", 0, 1e9},
          gravity.direct_below);
}

} // namespace slod
