#pragma once

#include <cstddef>

namespace slod {

/// Places, from 0 on, of two of n sorted values that hold a quantile of their distribution between them.
struct QuantileRanks {
    std::size_t low, high;
};

/// Those between which the q-quantile, q in (0, 1), lies with at least 95 % probability, whatever the
/// distribution: how many of n values are below it is binomial (David and Nagaraja 2003, Order Statistics,
/// section 7.1). Where n is too small for that they are the first and the last. n > 0. O(sqrt(n)).
QuantileRanks ranks_around(double q, std::size_t n);

} // namespace slod
