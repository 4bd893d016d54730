#pragma once

#include <string>
#include <string_view>

namespace slod {

/// The text as a string of a gnuplot script, whatever is in it.
std::string gnuplot_quoted(std::string_view text);

/// Runs gnuplot as a process of its own. Why that failed, with a remedy; empty when it did not.
std::string run_gnuplot(const std::string& script);

} // namespace slod
