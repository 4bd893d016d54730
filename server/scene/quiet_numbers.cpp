#include "scene/quiet_numbers.hpp"

#include "core/random.hpp"

namespace slod {
namespace {

constexpr unsigned bits = 32;

/// A primitive polynomial over two elements, its coefficients as bits without the first and the last one,
/// and the first direction numbers.
struct Primitive {
    unsigned degree;
    unsigned coefficients;
    std::array<std::uint32_t, 5> start;
};

constexpr std::array<Primitive, QuietNumbers::dimensions - 1> primitives{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
}};

using Directions = std::array<std::uint32_t, bits>;

constexpr Directions directions_of(const Primitive& primitive)
{
    Directions directions{};
    const unsigned degree = primitive.degree;
    for (unsigned i = 0; i < bits; ++i) {
        if (i < degree) {
            directions[i] = primitive.start[i] << (bits - 1 - i);
            continue;
        }
        directions[i] = directions[i - degree] ^ (directions[i - degree] >> degree);
        for (unsigned k = 1; k < degree; ++k)
            if ((primitive.coefficients >> (degree - 1 - k)) & 1U)
                directions[i] ^= directions[i - k];
    }
    return directions;
}

constexpr std::array<Directions, QuietNumbers::dimensions> all_directions()
{
    std::array<Directions, QuietNumbers::dimensions> all{};
    for (unsigned i = 0; i < bits; ++i)
        all[0][i] = 1U << (bits - 1 - i);
    for (std::size_t d = 1; d < all.size(); ++d)
        all[d] = directions_of(primitives[d - 1]);
    return all;
}

constexpr auto directions = all_directions();

constexpr std::uint32_t reversed(std::uint32_t x)
{
    std::uint32_t y = 0;
    for (unsigned i = 0; i < bits; ++i, x >>= 1)
        y = (y << 1) | (x & 1U);
    return y;
}

/// Flips each bit by a hash of the bits above it, which permutes every level of the binary partition of
/// [0, 1) at random (Laine and Karras 2011, Comput. Graph. Forum 30, 1277; constants of Burley 2020, JCGT
/// 9(4)).
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed)
{
    x = reversed(x);
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return reversed(x);
}

} // namespace

QuietNumbers::QuietNumbers(std::uint64_t seed, std::uint32_t stream) : scrambles_{}
{
    Random random(seed, stream, 0);
    for (std::uint32_t& scramble : scrambles_)
        scramble = random.bits();
}

QuietNumbers::Point QuietNumbers::point(std::uint32_t index) const
{
    Point point{};
    for (std::size_t d = 0; d < dimensions; ++d) {
        std::uint32_t x = 0;
        for (unsigned bit = 0; bit < bits; ++bit)
            if ((index >> bit) & 1U)
                x ^= directions[d][bit];
        point[d] = (double(scrambled(x, scrambles_[d])) + 0.5) * 0x1p-32;
    }
    return point;
}

} // namespace slod
