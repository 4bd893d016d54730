#pragma once

#include <filesystem>

#include "report/findings.hpp"

namespace slod::report {

/// Has gnuplot draw the pictures of all cases as SVG into files of a folder, and returns their content, each
/// with its case's number. What cannot be drawn is added to the problems.
std::vector<std::pair<std::string, std::string>> draw_pictures(Findings& findings,
                                                               const std::filesystem::path& folder);

/// What gnuplot is told of one; empty where no axis shows any of its points. `name` tells its parts from
/// those of other pictures on a page.
std::string plot_script(const test::CasePicture& picture, const std::string& name,
                        const std::filesystem::path& file);

} // namespace slod::report
