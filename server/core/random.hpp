#pragma once

#include <array>
#include <cstdint>

namespace slod {

/// 128 random bits, a function of counter and key alone: Philox4x32-10 (Salmon et al. 2011, SC11).
std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key);

/// The number in (0, 1) that random bits stand for: an odd multiple of 2^-53. The lowest 12 do not count.
double between_0_and_1(std::uint64_t bits);

/// Counter-based random numbers: the numbers of a particle
/// depend on the seed, the stream and the particle alone, not on who draws first.
class Random {
public:
    /// The generator of item `item` (a particle id) in stream `stream` (an emitter, a purpose).
    Random(std::uint64_t seed, std::uint32_t stream, std::uint64_t item);

    std::uint32_t bits(); ///< 32 random bits
    double uniform();     ///< in (0, 1), 52 bits

private:
    void refill();

    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 4> block_{};
    unsigned used_ = 4;
};

} // namespace slod
