#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cost/metrics.hpp"
#include "cost/setting.hpp"
#include "cost/trial.hpp"

/// Figure 9 of O'Brien et al. 2001: the fountain side by side, without clusters and with at most 30 droplets
/// in each.
namespace slod::cost {

inline constexpr double figure9_size = 30;
inline constexpr double figure9_factor = 6; ///< how much faster it is there
inline constexpr double figure9_s = 15;     ///< simulated time: the third stream, from 10 s on, is full

/// The fountain at the end of one run.
struct FountainView {
    Setting setting;
    double ms = 0; ///< of a frame of the last third, mean, when all streams run
    Points droplets;
};

/// Without clusters and regions of interest, in `flow` and in `rigid`. Call it inside ThreadTeam::run.
std::vector<FountainView> view_fountain(const SimulationSettings& scene, double simulated_s,
                                        const Clock& clock);

/// "flow 30: 0.031 ms a frame, 4.1 times as fast, the paper's 6", a line for each.
std::string text(const std::vector<FountainView>& views);
nlohmann::ordered_json json_of(const std::vector<FountainView>& views);

/// A gnuplot script that draws the views side by side, droplets as dots seen along y, into `picture`: SVG if
/// it is called so, else PNG.
std::string side_by_side_script(const std::vector<FountainView>& views, const std::filesystem::path& picture);

} // namespace slod::cost
