#include "core/portable_math.hpp"

#include <cmath>
#include <limits>

#include "core/sincos.inl"

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

constexpr const auto& over = inverse_factorials;

/// expm1 for |r| <= ln(2)/2, by its Taylor series; the first term left out is r^15 / 15!, 3e-19 of the sum.
/// Terms are added by pairs of pairs (Estrin 1960): in a chain each would wait for the one before. All but
/// the first come to less than a fifth of r, and so do their roundings.
double expm1_reduced(double r)
{
    const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const double low = ((over[2] + r * over[3]) + r2 * (over[4] + r * over[5])) +
                       r4 * ((over[6] + r * over[7]) + r2 * (over[8] + r * over[9]));
    const double high = ((over[10] + r * over[11]) + r2 * (over[12] + r * over[13])) + r4 * over[14];
    return r + r2 * (low + r8 * high);
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
    if (std::abs(x) < 0.34) // which is its own remainder
        return expm1_reduced(x);
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
    return sincos_of(angle);
}

} // namespace slod
