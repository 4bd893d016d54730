#include "core/portable_math.hpp"

#include <cmath>
#include <limits>

namespace slod {
namespace {

// ln 2 in two parts; the high one has 21 trailing zero bits, so k * high is exact for |k| < 2^20.
constexpr double ln2_high = 6.93147180369123816490e-01;
constexpr double ln2_low = 1.90821492927058770002e-10;

/// x = k ln 2 + r with |r| <= ln(2)/2.
struct Reduced {
    double k, r;
};

Reduced reduce(double x)
{
    const double k = std::nearbyint(x / (ln2_high + ln2_low));
    return {k, (x - k * ln2_high) - k * ln2_low};
}

/// expm1 for |r| <= ln(2)/2, by its Taylor series in Horner form.
double expm1_reduced(double r)
{
    double sum = 1.0;
    for (int n = 15; n >= 2; --n)
        sum = 1.0 + sum * r / n;
    return sum * r;
}

} // namespace

double portable_exp(double x)
{
    if (!(x < 709.7827128933841)) // just above the logarithm of the largest double
        return x > 0 ? std::numeric_limits<double>::infinity() : x;
    if (x < -745.2)
        return 0;
    const Reduced reduced = reduce(x);
    return std::ldexp(1.0 + expm1_reduced(reduced.r), int(reduced.k));
}

double portable_expm1(double x)
{
    if (!(std::abs(x) < 40)) // there 1 is beyond the last bit, or all there is
        return portable_exp(x) - 1.0;
    const Reduced reduced = reduce(x);
    const double scale = std::ldexp(1.0, int(reduced.k));
    return scale * expm1_reduced(reduced.r) + (scale - 1.0);
}

double portable_log(double x)
{
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent); // in [0.5, 1)
    if (mantissa < 0.70710678118654752) {
        mantissa *= 2;
        --exponent;
    }
    // log m = 2 atanh((m - 1) / (m + 1)), |argument| <= 0.172
    const double s = (mantissa - 1) / (mantissa + 1);
    const double s2 = s * s;
    double sum = 0;
    for (int n = 23; n >= 3; n -= 2)
        sum = (sum + 1.0 / n) * s2;
    const double log_mantissa = 2 * s + 2 * s * sum;
    return exponent * ln2_high + (log_mantissa + exponent * ln2_low);
}

SineCosine portable_sincos(double angle)
{
    // pi/2 in three parts of 33 bits (Cody and Waite 1980).
    constexpr double half_pi_1 = 1.57079632673412561417e+00;
    constexpr double half_pi_2 = 6.07710050630396597660e-11;
    constexpr double half_pi_3 = 2.02226624879595063154e-21;
    const double quadrant = std::nearbyint(angle / half_pi_1);
    const double r = ((angle - quadrant * half_pi_1) - quadrant * half_pi_2) - quadrant * half_pi_3;
    const double r2 = r * r;
    double sine = 1, cosine = 1;
    for (int n = 18; n >= 2; n -= 2) {
        sine = 1 - sine * r2 / (n * (n + 1));
        cosine = 1 - cosine * r2 / (n * (n - 1));
    }
    sine *= r;
    switch (static_cast<long long>(quadrant) & 3) {
    case 0:
        return {sine, cosine};
    case 1:
        return {cosine, -sine};
    case 2:
        return {-sine, -cosine};
    default:
        return {-cosine, sine};
    }
}

} // namespace slod
