#pragma once

#include <string>

#include "cost/report_files.hpp"

namespace slod::cost {

/// A page that needs no other file: the answer, the picture, the table, the scene's text and where it was
/// measured. Well-formed, without scripts. `svg` is a picture as gnuplot writes it, empty for none;
/// `scene_text` the scene's file.
std::string html_page(const Sweep& sweep, const Circumstances& circumstances, const std::string& svg,
                      const std::string& scene_text);

} // namespace slod::cost
