#include "idl/colour_map.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace slod {
namespace {

/// L* = 2 + 95 t; the hue turns from 285 to 105 degrees of CIE LCh while the chroma is what sRGB can show,
/// at most 80 sin(pi (0.04 + 0.93 t))^0.8. At even steps of t.
constexpr std::array<Colour, 17> path{{
    {0, 6, 31},
    {8, 20, 61},
    {37, 23, 86},
    {73, 20, 105},
    {111, 2, 115},
    {142, 0, 113},
    {171, 2, 110},
    {202, 1, 105},
    {232, 1, 94},
    {248, 55, 83},
    {255, 94, 78},
    {255, 127, 80},
    {255, 156, 88},
    {254, 181, 103},
    {249, 206, 135},
    {247, 229, 175},
    {250, 247, 224},
}};

std::uint8_t between(std::uint8_t from, std::uint8_t to, double share)
{
    return std::uint8_t(std::lround(std::lerp(double(from), double(to), share)));
}

} // namespace

Colour colour_of(double share)
{
    if (!(share > 0))
        return path.front();
    if (share >= 1)
        return path.back();
    const double place = share * double(path.size() - 1);
    const auto step = std::size_t(place);
    const Colour& from = path[step];
    const Colour& to = path[step + 1];
    const double rest = place - double(step);
    return {between(from.red, to.red, rest), between(from.green, to.green, rest),
            between(from.blue, to.blue, rest)};
}

} // namespace slod
