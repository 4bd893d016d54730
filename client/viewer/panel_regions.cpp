#include <cmath>
#include <cstdio>

#include <imgui.h>

#include "viewer/panels.hpp"

namespace slod::viewer {

namespace {

std::string text_of(double value)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return text.data();
}

const char* word_of(view::RegionEditor::Phase phase)
{
    using Phase = view::RegionEditor::Phase;
    return phase == Phase::Settled ? "" : phase == Phase::Pending ? "pending" : "dragged";
}

void take_over(RegionDraft& draft, const client::RegionInfo& region)
{
    draft.selected = region.region;
    draft.revision = region.revision;
    draft.max_cluster_size = region.max_cluster_size;
    draft.max_breadth = region.max_breadth;
    draft.precedence = region.precedence;
}

void draw_list(const Model& model, RegionDraft& draft)
{
    if (!ImGui::BeginTable("regions", 4, ImGuiTableFlags_ScrollY, ImVec2(290, 110)))
        return;
    for (const auto& [name, region] : model.connection.regions()) {
        ImGui::TableNextColumn();
        if (ImGui::Selectable(name.c_str(), draft.selected == name, ImGuiSelectableFlags_SpanAllColumns))
            take_over(draft, region);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(region.shape.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%llu", static_cast<unsigned long long>(region.clusters));
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(word_of(model.steering.editor.phase(name)));
    }
    ImGui::EndTable();
}

/// Settings of the selected region. They go to the server together, unless somebody else changed the region
/// meanwhile.
void draw_settings(Model& model, RegionDraft& draft)
{
    const auto found = model.connection.regions().find(draft.selected);
    if (found == model.connection.regions().end())
        return;
    const client::RegionInfo& region = found->second;
    const bool as_drafted = draft.max_cluster_size == region.max_cluster_size &&
                            draft.max_breadth == region.max_breadth && draft.precedence == region.precedence;
    if (as_drafted)
        draft.revision = region.revision;
    ImGui::Text("%s, revision %llu, %llu particles", region.region.c_str(),
                static_cast<unsigned long long>(region.revision),
                static_cast<unsigned long long>(region.particles));
    ImGui::InputDouble("max_cluster_size", &draft.max_cluster_size, 0, 0, "%.6g");
    ImGui::InputDouble("max_breadth", &draft.max_breadth, 0, 0, "%.6g");
    ImGui::InputInt("precedence", &draft.precedence);
    if (ImGui::Button("apply") && !as_drafted) {
        client::CommandRequest request{
            .kind = "set_roi", .region = region.region, .if_revision = draft.revision, .settings{}};
        if (draft.max_cluster_size != region.max_cluster_size)
            request.settings.emplace_back("max_cluster_size", text_of(draft.max_cluster_size));
        if (draft.max_breadth != region.max_breadth)
            request.settings.emplace_back("max_breadth", text_of(draft.max_breadth));
        if (draft.precedence != region.precedence)
            request.settings.emplace_back("precedence", std::to_string(draft.precedence));
        model.steering.send(std::move(request));
    }
    ImGui::SameLine();
    if (ImGui::Button("as it is"))
        take_over(draft, region);
    ImGui::SameLine();
    if (ImGui::Button("remove"))
        model.steering.send({.kind = "remove_roi", .region = region.region});
}

/// A region in the middle of the picture, a quarter as high.
void add_region(Model& model, const RegionDraft& draft)
{
    const view::Camera& camera = model.look.camera;
    constexpr double degree = 0.017453292519943295;
    const double size = 0.25 * camera.distance * std::tan(camera.field_of_view_deg * degree / 2);
    client::CommandRequest request{.kind = "add_roi", .region = draft.name.data()};
    request.centre = {camera.look_at.x(), camera.look_at.y(), camera.look_at.z()};
    request.settings = {{"shape", draft.sphere ? "sphere" : "box"}};
    if (draft.sphere)
        request.radius = size;
    else
        request.half_extent = {size, size, size};
    model.steering.send(std::move(request));
}

} // namespace

void draw_region_panel(Model& model, RegionDraft& draft)
{
    ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - 8, 250), ImGuiCond_FirstUseEver,
                            ImVec2(1, 0));
    if (ImGui::Begin("Regions of interest", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        draw_list(model, draft);
        ImGui::PushItemWidth(150);
        draw_settings(model, draft);
        ImGui::Separator();
        ImGui::InputText("name", draft.name.data(), draft.name.size());
        ImGui::Checkbox("sphere", &draft.sphere);
        ImGui::SameLine();
        if (ImGui::Button("add in the middle"))
            add_region(model, draft);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

} // namespace slod::viewer
