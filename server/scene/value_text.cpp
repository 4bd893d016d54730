#include "scene/value_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace slod {

std::string string_text(std::string_view text)
{
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            std::array<char, 8> escape{};
            std::snprintf(escape.data(), escape.size(), "\\u%04X", unsigned(c));
            result += escape.data();
        } else {
            result += c;
        }
    }
    return result + '"';
}

std::string float_text(double value)
{
    std::string text = number_text(value);
    if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text;
}

std::string pairs_text(const NumberPairs& pairs)
{
    std::vector<std::string> texts;
    for (const auto& [first, second] : pairs)
        texts.push_back("[" + float_text(first) + ", " + float_text(second) + "]");
    return "[" + joined(texts) + "]";
}

std::string range_text(const Range& range, bool infinity_allowed)
{
    // Whole numbers without an exponent, as TOML wants its integers.
    const auto bound = [](double value) {
        constexpr double exact = 1e15;
        const bool whole = std::abs(value) <= exact && value == std::floor(value);
        return whole ? std::to_string(static_cast<long long>(value)) : number_text(value);
    };
    const bool below = std::isfinite(range.minimum);
    const bool above = std::isfinite(range.maximum);
    std::string text = "any finite number";
    if (below && above)
        text = bound(range.minimum) + " to " + bound(range.maximum);
    else if (below)
        text = "at least " + bound(range.minimum);
    else if (above)
        text = "at most " + bound(range.maximum);
    return infinity_allowed ? text + ", or inf" : text;
}

} // namespace slod
