#include "viewer/panels.hpp"

#include <algorithm>

#include <imgui.h>

#include "viewer/hands.hpp"

namespace slod::viewer {

namespace {

ImVec4 colour_of(client::Contact contact)
{
    switch (contact) {
    case client::Contact::Live:
        return {0.4F, 0.9F, 0.5F, 1};
    case client::Contact::Stalled:
        return {1, 0.75F, 0.2F, 1};
    case client::Contact::NoServer:
        break;
    }
    return {1, 0.4F, 0.4F, 1};
}

void draw_alarms(const Model& model)
{
    for (const auto& [key, alarm] : model.alarms.entries())
        if (model.connection.server() && key.first == model.connection.server()->session)
            ImGui::TextWrapped("%s %s: %s", client::word_of(alarm.severity).data(), key.second.c_str(),
                               alarm.text.c_str());
}

void draw_traffic(const Model& model)
{
    const client::StreamMeter::Report traffic = model.connection.clusters_traffic();
    ImGui::Text("received  %.1f samples/s, %.2f MB/s", traffic.rate_hz, traffic.bytes_per_s * 1e-6);
    ImGui::Text("latency   p50 %.1f ms, p99 %.1f ms", traffic.latency_p50_ms, traffic.latency_p99_ms);
    ImGui::Text("total     %.1f MB, %llu frames", double(traffic.bytes) * 1e-6,
                static_cast<unsigned long long>(model.connection.complete_frames()));
    ImGui::Text("missed    %llu samples", static_cast<unsigned long long>(traffic.lost));
}

void draw_error(const client::MeasuredError& error)
{
    ImGui::Text("error     %.2g %% (%.2g to %.2g), p99 %.2g %%", 100 * error.median.value,
                100 * error.median.low, 100 * error.median.high, 100 * error.p99.value);
    if (error.target > 0)
        ImGui::Text("target    %.3g %%", 100 * error.target);
}

void plot(const view::History& history, const char* label, const std::string& series, const char* unit)
{
    const auto found = history.series().find(series);
    if (found == history.series().end())
        return;
    const std::vector<float>& values = found->second;
    const float highest = *std::max_element(values.begin(), values.end());
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%s %.3g %s", label, double(values.back()), unit);
    ImGui::PushID(series.c_str());
    ImGui::PlotLines("", values.data(), int(values.size()), 0, text.data(), 0, 1.2F * highest,
                     ImVec2(250, 32));
    ImGui::PopID();
}

/// The median error over time, within the band that it is in with 95 % probability.
void plot_error(const view::History& history)
{
    const auto found = history.series().find("error_percent");
    if (found == history.series().end())
        return;
    const std::vector<float>& median = found->second;
    const std::vector<float>& low = history.series().at("error_low");
    const std::vector<float>& high = history.series().at("error_high");
    const ImVec2 size(250, 48), corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y),
                         ImGui::GetColorU32(ImGuiCol_FrameBg));
    const float most = 1.2F * std::max(*std::max_element(high.begin(), high.end()), 1e-6F);
    const auto at = [&](std::size_t i, float percent) {
        return ImVec2(corner.x + size.x * float(i) / float(std::max<std::size_t>(median.size() - 1, 1)),
                      corner.y + size.y * (1 - percent / most));
    };
    for (std::size_t i = 0; i + 1 < median.size(); ++i) {
        canvas.AddQuadFilled(at(i, low[i]), at(i + 1, low[i + 1]), at(i + 1, high[i + 1]), at(i, high[i]),
                             ImGui::GetColorU32(ImGuiCol_PlotLines, 0.35F));
        canvas.AddLine(at(i, median[i]), at(i + 1, median[i + 1]), ImGui::GetColorU32(ImGuiCol_PlotLines));
    }
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "error %.2g to %.2g %%", double(low.back()), double(high.back()));
    canvas.AddText(ImVec2(corner.x + 4, corner.y + 2), ImGui::GetColorU32(ImGuiCol_Text), text.data());
}

/// Those that the scene calls for, in a part of the panel that scrolls.
void plot_phases(const view::History& history)
{
    ImGui::BeginChild("phases", ImVec2(268, 116));
    for (const std::string& phase : history.phases()) {
        const std::vector<float>& values = history.series().at(phase);
        if (std::any_of(values.begin(), values.end(), [](float ms) { return ms > 0; }))
            plot(history, phase.c_str(), phase, "ms");
    }
    ImGui::EndChild();
}

/// Where the panels of a side begin.
void place(float from_left, float from_top)
{
    ImGui::SetNextWindowPos(ImVec2(from_left, from_top), ImGuiCond_FirstUseEver);
}

constexpr ImGuiWindowFlags fitting = ImGuiWindowFlags_AlwaysAutoResize;
constexpr float margin = 8;

} // namespace

void Panels::draw(Model& model)
{
    if (model.show_panels) {
        draw_connection_panel(model);
        draw_performance_panel(model);
        draw_steering_panel(model);
        draw_colour_panel(model);
        draw_region_panel(model, draft_);
    }
    if (model.show_help)
        draw_help(model.show_help);
}

void draw_connection_panel(const Model& model)
{
    place(margin, margin);
    if (ImGui::Begin("Connection", nullptr, fitting)) {
        const client::Status status = model.connection.status();
        ImGui::TextColored(colour_of(status.contact), "%s",
                           names(status.contact)[std::size_t(status.contact)].data());
        if (!status.reason.empty()) {
            ImGui::PushTextWrapPos(260);
            ImGui::TextWrapped("%s", status.reason.c_str());
            ImGui::PopTextWrapPos();
        }
        if (const client::ServerInfo* server = model.connection.server()) {
            ImGui::Text("%s", server->scene_title.c_str());
            ImGui::Text("slod-server %s on %s, process %u", server->version.c_str(), server->host.c_str(),
                        server->process);
            if (const auto warning = wire::receive_buffer_warning(server->max_sample_bytes))
                ImGui::TextWrapped("%s", warning->c_str());
            if (model.connection.other_servers() > 0)
                ImGui::Text("%zu more servers on this domain", model.connection.other_servers());
        }
        draw_traffic(model);
        draw_alarms(model);
        if (!model.steering.notice().empty()) {
            ImGui::Separator();
            ImGui::PushTextWrapPos(260);
            ImGui::TextWrapped("%s", model.steering.notice().c_str());
            ImGui::PopTextWrapPos();
        }
    }
    ImGui::End();
}

void draw_performance_panel(const Model& model)
{
    place(margin, 210);
    if (ImGui::Begin("Server", nullptr, fitting)) {
        if (const client::ServerStats* stats = model.connection.stats()) {
            ImGui::Text("frame     %llu, time %.4g", static_cast<unsigned long long>(stats->frame),
                        stats->time);
            if (const client::ServerInfo* server = model.connection.server();
                server && server->frame_rate_target_hz > 0)
                ImGui::Text("target    %.4g Hz", server->frame_rate_target_hz);
            else
                ImGui::Text("target    as fast as it goes");
            ImGui::Text("particles %llu", static_cast<unsigned long long>(stats->particles));
            ImGui::Text("clusters  %llu", static_cast<unsigned long long>(stats->clusters));
            if (stats->control.target_ms > 0)
                ImGui::Text("sizes     times %.3g, %s", stats->control.cluster_size,
                            stats->control.state.c_str());
        }
        if (const client::MeasuredError* error = model.connection.error())
            draw_error(*error);
        plot(model.history, "frame rate", "frame_rate_hz", "Hz");
        plot(model.history, "real time factor", "real_time_factor", "");
        plot(model.history, "work", "work_ms", "ms");
        plot_error(model.history);
        if (ImGui::CollapsingHeader("milliseconds by phase"))
            plot_phases(model.history);
        ImGui::Text("viewer    %.1f pictures/s", double(ImGui::GetIO().Framerate));
    }
    ImGui::End();
}

void draw_steering_panel(Model& model)
{
    ImGui::SetNextWindowPos(ImVec2(margin, ImGui::GetIO().DisplaySize.y - margin), ImGuiCond_FirstUseEver,
                            ImVec2(0, 1));
    if (ImGui::Begin("Steering", nullptr, fitting)) {
        const client::ServerInfo* const server = model.connection.server();
        const bool paused = server && server->paused;
        if (ImGui::Button(paused ? "resume" : "pause"))
            model.toggle_pause();
        if (paused) {
            ImGui::SameLine();
            if (ImGui::Button("step"))
                model.step(1);
        }
        bool frozen = model.frozen();
        if (ImGui::Checkbox("freeze the view", &frozen))
            model.freeze(frozen);
        bool follows = model.steering.follows();
        if (ImGui::Checkbox("region follows the camera", &follows))
            model.steering.follow(follows);
        if (ImGui::Button("picture"))
            model.picture_wanted = true;
        ImGui::SameLine();
        if (ImGui::Button("fit"))
            model.fit_camera();
        ImGui::SameLine();
        ImGui::TextDisabled("h: help");
    }
    ImGui::End();
}

void draw_help(bool& open)
{
    ImGui::SetNextWindowPos(ImVec2(300, 120), ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Help", &open, fitting) && ImGui::BeginTable("controls", 2)) {
        for (const Control& control : controls()) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(control.input);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(control.effect);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace slod::viewer
