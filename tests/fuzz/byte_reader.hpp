#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "core/vectors.hpp"

namespace slod::test {

/// Takes values off the front of an input; where it has ended they are 0 and empty.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    bool at_end() const { return rest_.empty(); }

    std::uint8_t byte()
    {
        if (rest_.empty())
            return 0;
        const auto value = std::uint8_t(rest_.front());
        rest_.remove_prefix(1);
        return value;
    }

    /// Below the bound, which is 1 to 256.
    std::size_t below(std::size_t bound) { return byte() % bound; }

    template <class T, std::size_t n>
    const T& one_of(const std::array<T, n>& list)
    {
        return list[below(n)];
    }

    /// Mostly of a scene's size, also what is hard to have: zeros, infinities, extremes, no number.
    double number()
    {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        constexpr std::array<double, 8> hard{0, -0.0, 1e-310, 1e-30, 1e30, infinity, -infinity, NAN};
        const std::uint8_t high = byte();
        return high < hard.size() ? hard[high] : (high - 132.0) / 32 + byte() / 8192.0;
    }

    Vector3d vector()
    {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }

    /// Up to 31 bytes.
    std::string text()
    {
        const std::size_t asked = below(32), size = std::min(asked, rest_.size());
        const std::string taken(rest_.substr(0, size));
        rest_.remove_prefix(size);
        return taken;
    }

private:
    std::string_view rest_;
};

} // namespace slod::test
