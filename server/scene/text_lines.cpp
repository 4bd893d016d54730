#include "scene/text_lines.hpp"

#include <algorithm>

namespace slod {

void drop_byte_order_mark(std::string& first_line)
{
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (first_line.starts_with(mark))
        first_line.erase(0, mark.size());
}

TextLines::TextLines(const std::filesystem::path& file, std::uintmax_t max_bytes) : name_(file.string())
{
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found)
        refuse_file("there is no such file; check its name, which starts from the scene's folder.");
    if (status.type() != std::filesystem::file_type::regular)
        refuse_file("this is no regular file; name one.");
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    stream_.open(file, std::ios::binary);
    if (error || !stream_)
        refuse_file("the file cannot be read; check its permissions.");
    if (bytes > max_bytes)
        refuse_file("longer than " + std::to_string(max_bytes) + " bytes; use a coarser surface.");
}

bool TextLines::next()
{
    constexpr std::string_view blanks = " \t\r\v\f";
    while (std::getline(stream_, line_)) {
        if (++line_number_ == 1)
            drop_byte_order_mark(line_);
        if (line_.size() > longest)
            refuse_file("line " + std::to_string(line_number_) + " is longer than " +
                        std::to_string(longest) + " characters; name a file of text.");
        words_.clear();
        const std::string_view text = std::string_view(line_).substr(0, line_.find('#'));
        for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
            const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
            words_.push_back(text.substr(begin, end - begin));
            begin = text.find_first_not_of(blanks, end);
        }
        if (!words_.empty())
            return true;
    }
    if (stream_.bad())
        refuse_file("reading failed; check the disk.");
    return false;
}

double TextLines::number(std::string_view word) const
{
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        refuse("\"" + std::string(word) + "\" is no finite number; write one, such as 0.5.");
    if (std::abs(value) > 1e30)
        refuse("\"" + std::string(word) + "\" is out of range; use -1e30 to 1e30.");
    return value;
}

void TextLines::refuse(const std::string& why) const
{
    constexpr std::size_t shown = 60;
    std::string text = line_.size() > shown ? line_.substr(0, shown) + "..." : line_;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
        '?');
    throw UnusableText(name_ + ":" + std::to_string(line_number_) + ": \"" + text + "\": " + why);
}

void TextLines::refuse_file(const std::string& why) const
{
    throw UnusableText(name_ + ": " + why);
}

} // namespace slod
