#pragma once

#include <filesystem>
#include <string>

#include "cost/sweep.hpp"

namespace slod::cost {

/// Where and of what a sweep was made.
struct Circumstances {
    std::string scene;       ///< its title
    std::string version;     ///< of the program
    std::string machine;     ///< name and processors
    std::uint64_t particles; ///< at the end; of the unclustered run
    int frames;
    int threads;
    std::string opening{}; ///< the key of gravity that the settings' opening is; empty without gravity
};

std::string csv_text(const Sweep& sweep);
std::string json_text(const Sweep& sweep, const Circumstances& circumstances);

/// One line per setting, for a terminal.
std::string table_text(const Sweep& sweep);

/// A gnuplot script that draws error against milliseconds, both logarithmic, a front for each motion, into
/// `picture` without its extension: .png and .svg.
std::string plot_script(const Sweep& sweep, const Circumstances& circumstances,
                        const std::filesystem::path& picture);

} // namespace slod::cost
