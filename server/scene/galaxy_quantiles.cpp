#include "scene/galaxy_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.hpp"

namespace slod {

namespace {

constexpr double widest_deviate = 5;
constexpr std::size_t quantile_count = std::tuple_size_v<NormalQuantiles>;
constexpr double deviate_step = 2 * widest_deviate / double(quantile_count - 1);

double normal_density(double deviate)
{
    return portable_exp(-0.5 * deviate * deviate) / std::sqrt(2 * std::numbers::pi);
}

/// Shares of a normal distribution below the deviates of the quantiles.
NormalQuantiles normal_shares()
{
    constexpr int parts = 64;
    constexpr double part = deviate_step / parts;
    NormalQuantiles below{};
    // What lies below the first one, by the leading terms of its asymptotic series.
    const double first = widest_deviate * widest_deviate;
    below[0] = normal_density(widest_deviate) / widest_deviate * (1 - 1 / first + 3 / (first * first));
    for (std::size_t q = 1; q < quantile_count; ++q) {
        below[q] = below[q - 1];
        for (int k = 0; k < parts; ++k)
            below[q] += part * normal_density(deviate_of_quantile(q - 1) + (k + 0.5) * part);
    }
    return below;
}

} // namespace

double deviate_of_quantile(std::size_t quantile)
{
    return double(quantile) * deviate_step - widest_deviate;
}

double share_of_quantile(std::size_t quantile)
{
    return deviate_step * normal_density(deviate_of_quantile(quantile));
}

NormalQuantiles normal_quantiles(std::span<const double> values, std::span<const double> below)
{
    static const NormalQuantiles shares = normal_shares();
    NormalQuantiles quantiles{};
    std::size_t k = 1;
    for (std::size_t q = 0; q < quantile_count; ++q) {
        const double target = shares[q] * below.back();
        while (k + 1 < values.size() && below[k] < target)
            ++k;
        const double inside = below[k] - below[k - 1];
        const double part = inside > 0 ? std::clamp((target - below[k - 1]) / inside, 0.0, 1.0) : 0;
        quantiles[q] = values[k - 1] + part * (values[k] - values[k - 1]);
    }
    return quantiles;
}

double value_at(const NormalQuantiles& quantiles, double deviate)
{
    const double x = (std::clamp(deviate, -widest_deviate, widest_deviate) + widest_deviate) / deviate_step;
    const std::size_t q = std::min(std::size_t(x), quantile_count - 2);
    return quantiles[q] + (x - double(q)) * (quantiles[q + 1] - quantiles[q]);
}

std::array<double, 2> normal_pair(double u, double v)
{
    const double size = std::sqrt(-2 * portable_log(u));
    const SineCosine turn = portable_sincos(2 * std::numbers::pi * v);
    return {size * turn.cosine, size * turn.sine};
}

} // namespace slod
