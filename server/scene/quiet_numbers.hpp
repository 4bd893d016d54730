#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace slod {

/// Random points of the unit cube that keep more even distances than independent ones: a Sobol sequence
/// (directions of Joe and Kuo 2008, SIAM J. Sci. Comput. 30, 2635), scrambled as Owen (1995) has it. Each
/// point by itself is uniform; sums over many of them have far less noise. Point `index` depends on the seed,
/// the stream and the index alone.
class QuietNumbers {
public:
    static constexpr std::size_t dimensions = 7;
    using Point = std::array<double, dimensions>;

    QuietNumbers(std::uint64_t seed, std::uint32_t stream);

    /// Numbers in (0, 1).
    Point point(std::uint32_t index) const;

private:
    std::array<std::uint32_t, dimensions> scrambles_;
};

} // namespace slod
