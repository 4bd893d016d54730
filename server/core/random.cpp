#include "core/random.hpp"

#include "core/philox.inl"

namespace slod {

std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key)
{
    Philox state{counter[0], counter[1], counter[2], counter[3], key[0], key[1]};
    for (int round = 0; round < 10; ++round)
        state.round();
    return {state.x0, state.x1, state.x2, state.x3};
}

double between_0_and_1(std::uint64_t bits)
{
    return fraction_of(bits);
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
