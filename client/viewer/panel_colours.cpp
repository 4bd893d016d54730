#include <cstdio>

#include <imgui.h>

#include "viewer/panels.hpp"

namespace slod::viewer {

namespace {

constexpr float legend_width = 200, legend_height = 14;

/// The colours from end to end, with what the ends and the middle stand for.
void draw_legend(const view::Range& range, bool logarithmic)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    constexpr int steps = 64;
    for (int step = 0; step < steps; ++step) {
        const float left = corner.x + legend_width * float(step) / steps;
        const float right = corner.x + legend_width * float(step + 1) / steps;
        draw->AddRectFilled(ImVec2(left, corner.y), ImVec2(right, corner.y + legend_height),
                            view::colour_on_black((step + 0.5) / steps));
    }
    ImGui::Dummy(ImVec2(legend_width, legend_height));
    ImGui::Text("%.3g", range.low);
    ImGui::SameLine(0.4F * legend_width);
    ImGui::TextDisabled("%.3g", view::value_at(0.5, range, logarithmic));
    ImGui::SameLine(0.85F * legend_width);
    ImGui::Text("%.3g", range.high);
}

void draw_region_legend(const Model& model)
{
    constexpr std::size_t most = 16;
    std::size_t shown = 0;
    for (const auto& entry : model.connection.regions()) {
        if (++shown > most)
            break;
        const ImVec4 colour = ImGui::ColorConvertU32ToFloat4(view::region_colour(entry.first));
        ImGui::TextColored(colour, "%s", entry.first.c_str());
    }
}

void draw_range(view::ColourScale& scale, const view::Range& range)
{
    if (ImGui::Checkbox("automatic range", &scale.automatic) && !scale.automatic) {
        scale.low = range.low;
        scale.high = range.high;
    }
    if (scale.automatic)
        return;
    ImGui::SetNextItemWidth(legend_width);
    ImGui::InputDouble("low", &scale.low, 0, 0, "%.6g");
    ImGui::SetNextItemWidth(legend_width);
    ImGui::InputDouble("high", &scale.high, 0, 0, "%.6g");
    if (!(scale.high > scale.low) || (scale.logarithmic && !(scale.low > 0)))
        ImGui::TextWrapped("no colours: low must be below high, and above 0 on a logarithmic scale");
}

} // namespace

void draw_colour_panel(Model& model)
{
    ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - 8, 8), ImGuiCond_FirstUseEver,
                            ImVec2(1, 0));
    if (ImGui::Begin("Colours", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        view::ColourScale& scale = model.look.colours;
        ImGui::SetNextItemWidth(legend_width);
        if (ImGui::BeginCombo("by", names(scale.by)[std::size_t(scale.by)].data())) {
            const auto all = names(view::ColourBy{});
            for (std::size_t i = 0; i < all.size(); ++i)
                if (ImGui::Selectable(all[i].data(), scale.by == view::ColourBy(i)))
                    scale.by = view::ColourBy(i);
            ImGui::EndCombo();
        }
        if (scale.by == view::ColourBy::Region) {
            draw_region_legend(model);
        } else {
            draw_legend(model.colour_range, scale.logarithmic);
            ImGui::Checkbox("logarithmic", &scale.logarithmic);
            draw_range(scale, model.colour_range);
        }
        auto exposure = float(model.look.exposure);
        ImGui::SetNextItemWidth(legend_width);
        if (ImGui::SliderFloat("exposure", &exposure, 0.01F, 100, "%.2f", ImGuiSliderFlags_Logarithmic))
            model.look.exposure = double(exposure);
        ImGui::Checkbox("shapes of near clusters", &model.look.detail.shapes);
        ImGui::Checkbox("outlines of regions", &model.show_outlines);
    }
    ImGui::End();
}

} // namespace slod::viewer
