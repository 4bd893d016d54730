#include "tree/divide.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::size_t many = 4096; ///< keys whose halves are worth a task each

/// Keys of the lower of two halves of `parts` parts.
std::uint32_t lower_count(std::uint32_t count, std::uint32_t parts)
{
    return std::uint32_t(std::uint64_t{count} * (parts / 2) / parts);
}

int longest_axis(std::span<const DivisionKey> keys)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::array<float, 3> lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (const DivisionKey& key : keys) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], key.x[axis]);
            upper[axis] = std::max(upper[axis], key.x[axis]);
        }
    }
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (upper[std::size_t(axis)] - lower[std::size_t(axis)] >
            upper[std::size_t(longest)] - lower[std::size_t(longest)])
            longest = axis;
    return longest;
}

} // namespace

void divide(std::span<DivisionKey> keys, std::uint32_t parts)
{
    if (parts < 2)
        return;
    const int axis = longest_axis(keys);
    const std::uint32_t lower = lower_count(std::uint32_t(keys.size()), parts);
    std::nth_element(keys.begin(), keys.begin() + lower, keys.end(),
                     [axis](const DivisionKey& a, const DivisionKey& b) {
                         return a.x[axis] != b.x[axis] ? a.x[axis] < b.x[axis] : a.index < b.index;
                     });
    const auto divide_lower = [&] { divide(keys.first(lower), parts / 2); };
    const auto divide_upper = [&] { divide(keys.subspan(lower), parts - parts / 2); };
    if (keys.size() >= many) {
        run_both(divide_lower, divide_upper);
        return;
    }
    divide_lower();
    divide_upper();
}

std::uint32_t part_begin(std::uint32_t count, std::uint32_t parts, std::uint32_t part)
{
    std::uint32_t begin = 0;
    while (parts > 1 && part > 0) {
        const std::uint32_t lower = lower_count(count, parts);
        if (part < parts / 2) {
            count = lower;
            parts /= 2;
        } else {
            begin += lower;
            count -= lower;
            part -= parts / 2;
            parts -= parts / 2;
        }
    }
    return begin;
}

} // namespace slod
