#include "core/random.hpp"

#include <cmath>

#include "core/portable_math.hpp"

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

double Random::normal()
{
    // Marsaglia's polar method: no sine or cosine.
    for (;;) {
        const double u = 2 * uniform() - 1;
        const double v = 2 * uniform() - 1;
        const double s = u * u + v * v;
        if (s > 0 && s < 1)
            return u * std::sqrt(-2 * portable_log(s) / s);
    }
}

std::array<double, 3> Random::direction()
{
    for (;;) {
        const double x = 2 * uniform() - 1;
        const double y = 2 * uniform() - 1;
        const double z = 2 * uniform() - 1;
        const double r2 = x * x + y * y + z * z;
        if (r2 > 1e-6 && r2 <= 1) {
            const double scale = 1 / std::sqrt(r2);
            return {x * scale, y * scale, z * scale};
        }
    }
}

std::array<double, 2> Random::point_in_disc()
{
    for (;;) {
        const double x = 2 * uniform() - 1;
        const double y = 2 * uniform() - 1;
        if (x * x + y * y <= 1)
            return {x, y};
    }
}

} // namespace slod
