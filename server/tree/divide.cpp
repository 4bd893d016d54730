#include "tree/divide.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <immintrin.h>
#include <limits>

#include "core/assert.hpp"
#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::size_t many = 4096; ///< keys whose halves are worth a task each

/// Keys of the lower of two halves of `parts` parts.
std::uint32_t lower_count(std::uint32_t count, std::uint32_t parts)
{
    return std::uint32_t(std::uint64_t{count} * (parts / 2) / parts);
}

/// The longest side of what the keys span.
struct Side {
    std::size_t axis = 0;
    float lower = 0, length = 0;
};

Side longest_side(std::span<const DivisionKey> keys)
{
    // Whole keys in a register: what their index comes to as a number does not matter.
    static_assert(sizeof(DivisionKey) == sizeof(__m128));
    __m128 lowest = _mm_set1_ps(std::numeric_limits<float>::infinity()), highest = -lowest;
    for (const DivisionKey& key : keys) {
        const __m128 x = _mm_loadu_ps(reinterpret_cast<const float*>(&key));
        lowest = _mm_min_ps(x, lowest); // what is no number changes neither
        highest = _mm_max_ps(x, highest);
    }
    const __m128 length = highest - lowest;
    Side longest{0, lowest[0], length[0]};
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (length[axis] > longest.length)
            longest = {axis, lowest[axis], length[axis]};
    return longest;
}

/// Orders keys along an axis and those of one place by index. Numbers are in the order of their bits, but for
/// negative ones, which are in the reverse one; so all have a place, also what is no number.
std::uint64_t rank_of(const DivisionKey& key, std::size_t axis)
{
    const auto bits = std::bit_cast<std::uint32_t>(key.x[axis] + 0.0F); // there is one zero
    const std::uint32_t ordered = bits ^ (bits >> 31 != 0 ? 0xffff'ffffU : 0x8000'0000U);
    return std::uint64_t{ordered} << 32 | key.index;
}

/// The rank that `lower` of the keys are below. A histogram finds the few to choose it from, so that hardly a
/// branch depends on where a key is: no processor could foretell those.
std::uint64_t rank_at(std::span<const DivisionKey> keys, const Side& side, std::uint32_t lower,
                      std::span<DivisionKey> spare)
{
    constexpr std::size_t most_bins = 256;
    const std::size_t bins = std::min(most_bins, std::bit_ceil(keys.size() / 16 + 1));
    const float per_length = float(bins) / side.length;
    const auto bin_of = [&](const DivisionKey& key) {
        const float bin = (key.x[side.axis] - side.lower) * per_length;
        return std::size_t(int(std::min(float(bins - 1), bin))); // also of what is no number
    };
    std::array<std::uint32_t, most_bins> counts;
    std::fill_n(counts.begin(), bins, 0U);
    for (const DivisionKey& key : keys)
        ++counts[bin_of(key)];
    std::size_t bin = 0;
    for (; lower >= counts[bin]; ++bin)
        lower -= counts[bin];
    std::size_t found = 0;
    for (const DivisionKey& key : keys)
        if (bin_of(key) == bin)
            spare[found++] = key;
    const auto before = [&](const DivisionKey& a, const DivisionKey& b) {
        return rank_of(a, side.axis) < rank_of(b, side.axis);
    };
    std::nth_element(spare.begin(), spare.begin() + lower, spare.begin() + std::ptrdiff_t(found), before);
    return rank_of(spare[lower], side.axis);
}

/// Puts the first `lower` keys along the longest side in front of the others; both stay in order.
void halve(std::span<DivisionKey> keys, std::span<DivisionKey> spare, std::uint32_t lower)
{
    const Side side = longest_side(keys);
    const std::uint64_t middle = rank_at(keys, side, lower, spare);
    std::size_t below = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::size_t is_below = rank_of(keys[i], side.axis) < middle ? 1 : 0;
        const DivisionKey key = keys[i];
        keys[below] = spare[i - below] = key;
        below += is_below;
    }
    std::copy_n(spare.begin(), keys.size() - below, keys.begin() + std::ptrdiff_t(below));
}

} // namespace

void divide(std::span<DivisionKey> keys, std::span<DivisionKey> spare, std::uint32_t parts)
{
    if (parts < 2)
        return;
    SLOD_ASSERT(parts <= keys.size());
    const std::uint32_t lower = lower_count(std::uint32_t(keys.size()), parts);
    halve(keys, spare, lower);
    const auto divide_lower = [&] { divide(keys.first(lower), spare.first(lower), parts / 2); };
    const auto divide_upper = [&] { divide(keys.subspan(lower), spare.subspan(lower), parts - parts / 2); };
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
