#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cost/row.hpp"
#include "scene/scene.hpp"

namespace slod::cost {

/// What a scene's settings are to be chosen for: one of the two.
struct Wish {
    std::optional<double> frame_rate_hz{}; ///< to be made, at the least error
    std::optional<double> error{};         ///< in noise floors, to be kept to in the least time
};

/// The row that the wish asks for; none when no setting fulfils it.
std::optional<Row> choose(const std::vector<Row>& rows, const Wish& wish);

/// The scene with the setting, at the frame rate that is wished for or, with steps, as often as its frames
/// are cut. The controller is off, or it would choose anew.
Scene with_choice(const Scene& scene, const Setting& setting, const Wish& wish);

/// `text` with its values changed to those of `wanted`, comments and all; where values cannot be changed line
/// by line, `wanted` written anew without comments.
std::string edited(const SceneText& text, const Scene& wanted);

} // namespace slod::cost
