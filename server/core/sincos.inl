// portable_sincos() for those who need a copy of their own: core/portable_math.cpp, and the kernels, each
// built for its own processor. Of plain arithmetic without a branch, so that loops over it can be vectorised.
// To be included outside of all namespaces, once.

#include <cstdint>

#include "core/portable_math.hpp"

namespace {

/// (sin r - r) / r^3 and (cos r - 1) / r^2 for |r| <= pi/4, by pairs of pairs (Estrin 1960); the first terms
/// left out are 1e-19 and 2e-18 of sine and cosine.
inline slod::SineCosine bent_of(double r)
{
    // Constants of their own: no function that gives one is called.
    constexpr const auto& over = slod::inverse_factorials;
    constexpr double over_2 = over[2], over_3 = over[3], over_4 = over[4], over_5 = over[5], over_6 = over[6],
                     over_7 = over[7], over_8 = over[8], over_9 = over[9], over_10 = over[10],
                     over_11 = over[11], over_12 = over[12], over_13 = over[13], over_14 = over[14],
                     over_15 = over[15], over_16 = over[16], over_17 = over[17];
    const double x = r * r, x2 = x * x, x4 = x2 * x2;
    return {((x * over_5 - over_3) + x2 * (x * over_9 - over_7)) +
                x4 * ((x * over_13 - over_11) + x2 * (x * over_17 - over_15)),
            ((x * over_4 - over_2) + x2 * (x * over_8 - over_6)) +
                x4 * ((x * over_12 - over_10) + x2 * (x * over_16 - over_14))};
}

inline slod::SineCosine sincos_of(double angle)
{
    // pi/2 in three parts of 33 bits (Cody and Waite 1980).
    constexpr double half_pi_1 = 1.57079632673412561417e+00;
    constexpr double half_pi_2 = 6.07710050630396597660e-11;
    constexpr double half_pi_3 = 2.02226624879595063154e-21;
    constexpr double whole = 0x1.8p52; // a sum with this has no bits for a fraction left
    const double shifted = angle * (1 / half_pi_1) + whole;
    const double quadrant = shifted - whole;
    const double r = ((angle - quadrant * half_pi_1) - quadrant * half_pi_2) - quadrant * half_pi_3;
    const double r2 = r * r;
    const slod::SineCosine bent = bent_of(r);
    const double sine = r + r * r2 * bent.sine;
    const double cosine = 1 + r2 * bent.cosine;
    std::uint64_t turns; // by a right angle, in the lowest bits
    __builtin_memcpy(&turns, &shifted, sizeof turns);
    const double across = (turns & 1) != 0 ? cosine : sine;
    const double along = (turns & 1) != 0 ? sine : cosine;
    return {(turns & 2) != 0 ? -across : across, ((turns + 1) & 2) != 0 ? -along : along};
}

} // namespace
