#include "viewer/hands.hpp"

#include <array>
#include <cmath>
#include <exception>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "viewer/camera_file.hpp"

namespace slod::viewer {

namespace {

constexpr std::array all_controls{
    Control{"left drag", "turn the camera; on a handle: move or resize the region"},
    Control{"right or middle drag", "shift the camera"},
    Control{"wheel", "zoom to the cursor"},
    Control{"Esc", "put the region that is dragged back"},
    Control{"r", "fit the scene into the picture"},
    Control{"1 ... 6", "look from the front, back, right, left, top, bottom"},
    Control{"Ctrl-S, Ctrl-L", "save and load the camera"},
    Control{"Space", "pause or resume the simulation"},
    Control{"Down, Page Down", "while paused: one frame, fifty frames"},
    Control{"d", "freeze the view, or let it go on; the simulation does not notice"},
    Control{"e", "write a picture without panels"},
    Control{"o", "outlines of the regions on or off"},
    Control{"p", "panels on or off"},
    Control{"h", "this help on or off"},
};

/// A place of ImGui's, which counts in window coordinates, in pixels of the picture.
view::Pixel pixel_of(const ImVec2& place)
{
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    return {place.x * scale.x, place.y * scale.y};
}

void use_mouse(Model& model, const std::optional<view::Pixel>& press)
{
    const ImGuiIO& io = ImGui::GetIO();
    view::RegionEditor& editor = model.steering.editor;
    const view::Pixel cursor = pixel_of(io.MousePos);
    const view::Pixel moved = pixel_of(io.MouseDelta);
    if (press && !io.WantCaptureMouse && model.show_outlines)
        if (const auto grip = editor.grip_at(model.lens(), *press))
            editor.begin(*grip, *press);
    if (editor.dragging()) {
        editor.drag(model.lens(), cursor);
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left))
            editor.release();
        return;
    }
    if (io.WantCaptureMouse)
        return;
    view::Camera& camera = model.look.camera;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
        camera = view::orbited(camera, moved.x, moved.y);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
        camera = view::panned(camera, model.viewport, moved.x, moved.y);
    if (io.MouseWheel != 0) {
        constexpr double factor_per_notch = 0.85;
        camera = view::zoomed(camera, model.viewport, cursor.x, cursor.y,
                              std::pow(factor_per_notch, double(io.MouseWheel)));
    }
}

/// Files can fail; the notice says how.
template <class Action>
void try_with_files(Model& model, const Action& action)
try {
    action();
} catch (const std::exception& error) {
    model.steering.set_notice(error.what());
}

void load(Model& model)
{
    const auto camera = load_camera(model.camera_file);
    if (camera)
        model.look.camera = *camera;
    model.steering.set_notice(camera ? "camera loaded" : "there is no " + model.camera_file.string());
}

void save(Model& model)
{
    save_camera(model.look.camera, model.camera_file);
    model.steering.set_notice("camera saved in " + model.camera_file.string());
}

void use_key_with_control(Model& model, int key)
{
    if (key == GLFW_KEY_S)
        try_with_files(model, [&] { save(model); });
    if (key == GLFW_KEY_L)
        try_with_files(model, [&] { load(model); });
}

void use_key(Model& model, int key)
{
    constexpr int views = int(names(view::AxisView{}).size());
    for (const int first : {GLFW_KEY_1, GLFW_KEY_KP_1})
        if (key >= first && key < first + views)
            model.look.camera = view::seen_from(model.look.camera, view::AxisView(key - first));
    switch (key) {
    case GLFW_KEY_ESCAPE:
        return model.steering.editor.cancel();
    case GLFW_KEY_R:
        return model.fit_camera();
    case GLFW_KEY_SPACE:
        return model.toggle_pause();
    case GLFW_KEY_DOWN:
        return model.step(1);
    case GLFW_KEY_PAGE_DOWN:
        return model.step(50);
    case GLFW_KEY_D:
        return model.freeze(!model.frozen());
    case GLFW_KEY_E:
        model.picture_wanted = true;
        return;
    case GLFW_KEY_O:
        model.show_outlines = !model.show_outlines;
        return;
    case GLFW_KEY_P:
        model.show_panels = !model.show_panels;
        return;
    case GLFW_KEY_H:
        model.show_help = !model.show_help;
        return;
    default:
        return;
    }
}

} // namespace

std::span<const Control> controls()
{
    return all_controls;
}

void use_hands(Model& model, const Input& input)
{
    use_mouse(model, input.press);
    if (ImGui::GetIO().WantTextInput)
        return;
    for (const KeyPress& press : input.keys)
        press.control ? use_key_with_control(model, press.key) : use_key(model, press.key);
}

} // namespace slod::viewer
