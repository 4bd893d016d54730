#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>

#include <CLI/CLI.hpp>

#include "idl/output_place.hpp"

/// What options of command lines take. Each says of what it does not take what it takes instead; CLI11 puts
/// the option's name in front.
namespace slod {

/// Takes numbers from `least` to `most`, whole ones where the type is.
template <class Number>
CLI::Validator between(Number least, Number most)
{
    const auto complaint = [least, most](const std::string& text) -> std::string {
        Number value{};
        const char* const end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && last == end && value >= least && value <= most)
            return {};
        const bool unbounded =
            most == std::numeric_limits<Number>::max() && error != std::errc::result_out_of_range;
        std::ostringstream range;
        range << (std::is_integral_v<Number> ? "whole number" : "number");
        if (unbounded)
            range << " of at least " << least;
        else
            range << " from " << least << " to " << most;
        return text + " is no " + range.str();
    };
    return {complaint, ""};
}

/// Takes 0, 1, 2 and so on, as far as the type goes.
template <class Number>
CLI::Validator at_least_zero()
{
    return between<Number>(0, std::numeric_limits<Number>::max());
}

/// Takes 1, 2 and so on.
inline CLI::Validator at_least_one()
{
    return between<std::uint64_t>(1, std::numeric_limits<std::uint64_t>::max());
}

/// Takes a file that can be made or replaced.
inline CLI::Validator writable_file()
{
    return {[](const std::string& text) { return unwritable_file(text); }, ""};
}

/// The same for a picture: its name says that it is PNG, where it is a file's.
inline CLI::Validator writable_png()
{
    return {[](const std::string& text) {
                const std::filesystem::path place(text);
                if (std::string problem = unwritable_file(place); !problem.empty())
                    return problem;
                std::error_code unknown;
                const bool is_png = place.extension() == ".png" || place.extension() == ".PNG";
                return is_png || std::filesystem::is_character_file(place, unknown)
                           ? std::string()
                           : text + " is no name of a PNG picture; let it end with .png";
            },
            ""};
}

/// Takes a folder that files can be made in, or that can be made.
inline CLI::Validator writable_folder()
{
    return {[](const std::string& text) { return unwritable_folder(text); }, ""};
}

} // namespace slod
