#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/settings.hpp"

namespace slod {

/// A file of text cannot be used; what() says where, why and what to do.
struct UnusableText : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Takes away what some editors begin a file of UTF-8 with.
void drop_byte_order_mark(std::string& first_line);

/// Reads a file of words line by line; passes a byte order mark over. Every function throws UnusableText.
class TextLines {
public:
    /// Longest line, characters.
    static constexpr std::size_t longest = 1U << 20;

    TextLines(const std::filesystem::path& file, std::uintmax_t max_bytes);

    /// Goes on to the next line that has words in front of any #; false after the last.
    bool next();

    /// Of this line.
    const std::vector<std::string_view>& words() const { return words_; }

    /// A word of this line as a finite number.
    double number(std::string_view word) const;

    /// Says of this line what is wrong with it, and what to do.
    [[noreturn]] void refuse(const std::string& why) const;

    /// Says so of the whole file.
    [[noreturn]] void refuse_file(const std::string& why) const;

private:
    std::string name_;
    std::ifstream stream_;
    std::string line_;
    std::vector<std::string_view> words_;
    std::uint64_t line_number_ = 0;
};

/// What `make` makes of a file's lines, or why it cannot be used.
template <class Make>
std::variant<std::invoke_result_t<Make, TextLines&>, Problems>
read_text(const std::filesystem::path& file, std::uintmax_t max_bytes, const Make& make)
{
    try {
        TextLines lines(file, max_bytes);
        return make(lines);
    } catch (const UnusableText& failure) {
        return Problems{failure.what()};
    }
}

/// A word as an integer; none where it is not one.
inline std::optional<std::int64_t> integer(std::string_view word)
{
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        return {};
    return value;
}

} // namespace slod
