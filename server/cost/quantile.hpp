#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slod::cost {

/// The value below which the share q of the others is, in [0, 1]; 0 where there are none.
inline double quantile(std::vector<double> values, double q)
{
    if (values.empty())
        return 0;
    const auto place = values.begin() + std::ptrdiff_t(q * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace slod::cost
