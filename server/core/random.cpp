#include "core/random.hpp"

namespace slod {

std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> x, std::array<std::uint32_t, 2> key)
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

double between_0_and_1(std::uint64_t bits)
{
    return (double(bits >> 12) + 0.5) *
           0x1p-52; // with one more bit the half would be rounded, at the end to 1
}

Random::Random(std::uint64_t seed, std::uint32_t stream, std::uint64_t item)
    : key_{std::uint32_t(seed), std::uint32_t(seed >> 32)}, counter_{0, stream, std::uint32_t(item),
                                                                     std::uint32_t(item >> 32)}
{}

void Random::refill()
{
    block_ = philox4x32_10(counter_, key_);
    ++counter_[0];
    used_ = 0;
}

std::uint32_t Random::bits()
{
    if (used_ == block_.size())
        refill();
    return block_[used_++];
}

double Random::uniform()
{
    const std::uint64_t high = bits();
    return between_0_and_1(high << 32 | bits());
}

} // namespace slod
