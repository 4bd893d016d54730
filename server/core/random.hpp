#pragma once

#include <array>
#include <cstdint>

namespace slod {

/// 128 random bits, a function of counter and key alone: Philox4x32-10 (Salmon et al. 2011, SC11).
inline std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> x,
                                                  std::array<std::uint32_t, 2> key)
{
    constexpr std::uint32_t multiplier0 = 0xD2511F53, multiplier1 = 0xCD9E8D57;
    constexpr std::uint32_t weyl0 = 0x9E3779B9, weyl1 = 0xBB67AE85;
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t product0 = std::uint64_t{multiplier0} * x[0];
        const std::uint64_t product1 = std::uint64_t{multiplier1} * x[2];
        x = {std::uint32_t(product1 >> 32) ^ x[1] ^ key[0], std::uint32_t(product1),
             std::uint32_t(product0 >> 32) ^ x[3] ^ key[1], std::uint32_t(product0)};
        key[0] += weyl0;
        key[1] += weyl1;
    }
    return x;
}

/// The number in (0, 1) that random bits stand for: an odd multiple of 2^-53. The lowest 12 do not count.
inline double between_0_and_1(std::uint64_t bits)
{
    return (double(bits >> 12) + 0.5) *
           0x1p-52; // with one more bit the half would be rounded, at the end to 1
}

/// Counter-based random numbers: the numbers of a particle
/// depend on the seed, the stream and the particle alone, not on who draws first.
class Random {
public:
    /// The generator of item `item` (a particle id) in stream `stream` (an emitter, a purpose).
    Random(std::uint64_t seed, std::uint32_t stream, std::uint64_t item)
        : key_{std::uint32_t(seed), std::uint32_t(seed >> 32)}, counter_{0, stream, std::uint32_t(item),
                                                                         std::uint32_t(item >> 32)}
    {}

    /// 32 random bits.
    std::uint32_t bits()
    {
        if (used_ == block_.size())
            refill();
        return block_[used_++];
    }

    /// In (0, 1), 52 bits.
    double uniform()
    {
        const std::uint64_t high = bits();
        return between_0_and_1(high << 32 | bits());
    }

private:
    void refill()
    {
        block_ = philox4x32_10(counter_, key_);
        ++counter_[0];
        used_ = 0;
    }

    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 4> block_{};
    unsigned used_ = 4;
};

} // namespace slod
