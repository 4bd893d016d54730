#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/exit_code.hpp"
#include "idl/option_checks.hpp"

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

} // namespace slod::client
