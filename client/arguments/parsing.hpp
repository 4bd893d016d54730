#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/exit_code.hpp"

namespace slod::client {

/// Reads a command line into what the options of `app` are bound to. When it is wrong, or asks for --help or
/// --version alone, has already printed what there is to say and gives the exit code.
std::optional<ExitCode> parse(CLI::App& app, int argc, const char* const* argv);

/// An option whose value is one of the names(Enum); its default is what `target` holds.
template <class Enum>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Enum& target, const std::string& help)
{
    const auto known = names(Enum{});
    const std::vector<std::string> all(known.begin(), known.end());
    const auto take = [all, &target](const std::string& word) {
        target = Enum(std::find(all.begin(), all.end(), word) - all.begin());
    };
    return app.add_option_function<std::string>(name, take, help)
        ->check(CLI::IsMember(all))
        ->option_text("NAME [" + all[std::size_t(target)] + "]");
}

/// Takes numbers from `least` to `most`, whole ones where the type is; says of others which are taken.
template <class Number>
CLI::Validator between(Number least, Number most)
{
    const auto complaint = [least, most](const std::string& text) -> std::string {
        Number value{};
        const char* const end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && last == end && value >= least && value <= most)
            return {};
        std::ostringstream range;
        range << (std::is_integral_v<Number> ? "whole number" : "number");
        if (most == std::numeric_limits<Number>::max())
            range << " of at least " << least;
        else
            range << " from " << least << " to " << most;
        return text + " is no " + range.str();
    };
    return {complaint, ""};
}

/// Takes 1, 2 and so on.
inline CLI::Validator at_least_one()
{
    return between<std::uint64_t>(1, std::numeric_limits<std::uint64_t>::max());
}

} // namespace slod::client
