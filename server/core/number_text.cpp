#include "core/number_text.hpp"

#include <array>
#include <charconv>

namespace slod {

std::string number_text(double value)
{
    std::array<char, 32> digits{}; // 17 digits, sign, point and exponent are 24
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

} // namespace slod
