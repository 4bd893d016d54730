#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "viewer/model.hpp"

namespace slod::viewer {

/// What somebody is typing into the panel of regions; not yet asked of the server.
struct RegionDraft {
    std::string selected;       ///< region whose settings are edited; empty: none
    std::uint64_t revision = 0; ///< that the draft began with
    double max_cluster_size = 0;
    double max_breadth = 0;
    int precedence = 0;
    std::array<char, 33> name{"region-1"};
    bool sphere = false;
};

/// The panels around the scene, with Dear ImGui.
class Panels {
public:
    void draw(Model& model);

private:
    RegionDraft draft_;
};

// One panel each.
void draw_connection_panel(const Model& model);
void draw_performance_panel(const Model& model);
void draw_steering_panel(Model& model);
void draw_colour_panel(Model& model);
void draw_region_panel(Model& model, RegionDraft& draft);
void draw_help(bool& open);

} // namespace slod::viewer
