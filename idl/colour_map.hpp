#pragma once

#include <cstdint>

namespace slod {

struct Colour {
    std::uint8_t red, green, blue;
};

/// The colour of `share`, in [0, 1]: from night blue over magenta and orange to cream. Lightness (CIE L*)
/// rises evenly, so that equal steps of the share look equal, also in grey; NaN and what is below 0 are as 0.
Colour colour_of(double share);

} // namespace slod
