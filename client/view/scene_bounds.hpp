#pragma once

#include "common/frame_assembler.hpp"
#include "view/camera.hpp"

namespace slod::view {

/// A ball.
struct Ball {
    Vector centre{0, 0, 0};
    double radius = 0; ///< 0: nothing is there
};

/// Where nine tenths of a frame's clusters are: a ball about their median place. Outliers do not move it.
Ball bulk_of(const client::ClusterFrame& frame);

} // namespace slod::view
