#pragma once

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

} // namespace slod
