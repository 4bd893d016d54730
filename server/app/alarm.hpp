#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace slod {

enum class AlarmSeverity : std::uint8_t { Warning, Error };

constexpr std::array<std::string_view, 2> names(AlarmSeverity)
{
    return {"warning", "error"};
}

/// Something that whoever runs the scene should know.
struct Alarm {
    std::string_view name; ///< one of a fixed list
    AlarmSeverity severity = AlarmSeverity::Warning;
    std::uint64_t first_frame = 0, last_frame = 0; ///< in which it was so
    std::uint64_t occurrences =
        0;            ///< frames or particles, what the text counts; looks where it counts nothing
    std::string text; ///< one sentence, with the remedy

    friend bool operator==(const Alarm&, const Alarm&) = default;
};

} // namespace slod
