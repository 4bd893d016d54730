// Random bits for those who need a copy of their own: core/random.cpp, and the kernels, each built for its
// own processor. To be included outside of all namespaces, once.

#include <cstdint>

namespace {

/// Counter and key of Philox4x32 (Salmon et al. 2011, SC11), a word each.
struct Philox {
    std::uint32_t x0, x1, x2, x3, key0, key1;

    /// Ten of these make the counter's 128 random bits.
    void round()
    {
        const std::uint64_t product0 = std::uint64_t{0xD2511F53} * x0;
        const std::uint64_t product1 = std::uint64_t{0xCD9E8D57} * x2;
        x0 = std::uint32_t(product1 >> 32) ^ x1 ^ key0;
        x1 = std::uint32_t(product1);
        x2 = std::uint32_t(product0 >> 32) ^ x3 ^ key1;
        x3 = std::uint32_t(product0);
        key0 += 0x9E3779B9;
        key1 += 0xBB67AE85;
    }
};

/// The number in (0, 1) that the upper 52 bits stand for: an odd multiple of 2^-53. With one more bit the
/// half would be rounded, at the end to 1.
inline double fraction_of(std::uint64_t bits)
{
    const std::uint64_t from_1_to_2 = bits >> 12 | 0x3ff0000000000000;
    double number;
    __builtin_memcpy(&number, &from_1_to_2, sizeof number);
    return (number - 1) + 0x1p-53;
}

} // namespace
