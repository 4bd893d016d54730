#pragma once

#include <cstdint>

namespace slod {

/// Bits of a coordinate that a Morton code of three fits into 64.
inline constexpr unsigned morton_bits = 21;

/// The lowest 21 bits of `value`, each followed by two zero bits: one coordinate of a Morton code (Morton
/// 1966), shifted by 0, 1 and 2 for x, y and z.
constexpr std::uint64_t spread_bits(std::uint64_t value)
{
    value &= 0x1f'ffff;
    value = (value | value << 32) & 0x001f'0000'0000'ffff;
    value = (value | value << 16) & 0x001f'0000'ff00'00ff;
    value = (value | value << 8) & 0x100f'00f0'0f00'f00f;
    value = (value | value << 4) & 0x10c3'0c30'c30c'30c3;
    return (value | value << 2) & 0x1249'2492'4924'9249;
}

} // namespace slod
