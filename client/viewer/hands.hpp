#pragma once

#include <span>

#include "viewer/model.hpp"
#include "viewer/window.hpp"

namespace slod::viewer {

/// What mouse and keys do, one row each; help shows it.
struct Control {
    const char* input;
    const char* effect;
};
std::span<const Control> controls();

/// Lets the mouse, as Dear ImGui holds it, turn the camera and drag regions, and the keys do what they do.
/// What a panel takes is not taken here.
void use_hands(Model& model, const Input& input);

} // namespace slod::viewer
