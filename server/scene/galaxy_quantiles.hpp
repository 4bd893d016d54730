#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace slod {

/// Quantiles of a distribution at the shares that a normal distribution has below -5, -4.8, ... 5. A draw is
/// then a smooth function of a normal deviate, and the tails are as well resolved as the middle.
using NormalQuantiles = std::array<double, 51>;

/// The normal deviates of the quantiles, and the shares of particles about each; the shares sum to 1.
double deviate_of_quantile(std::size_t quantile);
double share_of_quantile(std::size_t quantile);

/// Quantiles of a distribution that has below[k] particles under the value values[k]; both ascend, the first
/// of `below` is 0 and the last one positive.
NormalQuantiles normal_quantiles(std::span<const double> values, std::span<const double> below);

/// The value that belongs to a deviate; deviates beyond 5 count as 5.
double value_at(const NormalQuantiles& quantiles, double deviate);

/// Two independent normal deviates from two numbers in (0, 1) (Box and Muller 1958, Ann. Math. Stat. 29,
/// 610).
std::array<double, 2> normal_pair(double u, double v);

} // namespace slod
