#pragma once

#include <array>
#include <cstddef>

namespace slod {

/// Elementary functions from +, -, *, / alone. The C library picks among variants by processor, whose
/// last bits differ; whatever enters the state uses these, so that the state has the same bits everywhere.
/// Relative error below 4e-16 wherever the result is a normal number.
double portable_exp(double x);
double portable_expm1(double x);
double portable_log(double x); ///< x > 0

/// Sine and cosine of `angle` [rad], |angle| below 1e5. Absolute error below 4e-16.
struct SineCosine {
    double sine, cosine;
};
SineCosine portable_sincos(double angle);

/// 1 / n!, for series by powers.
inline constexpr std::array<double, 19> inverse_factorials = [] {
    std::array<double, 19> inverse{1};
    double factorial = 1; // exact up to 18!
    for (std::size_t n = 1; n < inverse.size(); ++n)
        inverse[n] = 1 / (factorial *= double(n));
    return inverse;
}();

} // namespace slod
