#pragma once

#include <optional>
#include <vector>

#include "common/messages.hpp"
#include "view/lens.hpp"

namespace slod::view {

/// Place and size of a box or a sphere.
struct RegionPose {
    bool sphere = false; ///< else a box
    Vector centre{0, 0, 0};
    Vector half_extent{1, 1, 1}; ///< of a box
    double radius = 1;           ///< of a sphere

    friend bool operator==(const RegionPose&, const RegionPose&) = default;
};

/// Nothing for a region that is neither box nor sphere.
std::optional<RegionPose> pose_of(const client::RegionInfo& region);

/// What a region is dragged by: the middle moves it, a face of a box moves with the opposite face at rest,
/// and one of the six points of a sphere changes its radius.
struct Handle {
    int axis = -1; ///< 0, 1, 2 for x, y, z of a face; -1: the middle
    int side = 0;  ///< of a face: -1 or 1

    bool is_centre() const { return axis < 0; }
    friend bool operator==(const Handle&, const Handle&) = default;
};

Vector place_of(const Handle& handle, const RegionPose& pose);

/// All handles of a region, the middle first.
const std::vector<Handle>& all_handles();

/// Whether a handle can be dragged as it is seen: not a face whose axis points at the eye.
bool can_be_dragged(const Handle& handle, const RegionPose& pose, const Lens& lens);

/// The pose after its handle was dragged from one pixel to another; the same pose when the pixels say
/// nothing, as where an axis is seen end on.
RegionPose dragged(const RegionPose& pose, const Handle& handle, const Lens& lens, const Pixel& from,
                   const Pixel& to);

/// A straight piece of an outline.
struct Segment {
    Vector from, to;
};

/// What shows a region: the edges of a box, three great circles of a sphere, the edges of a frustum, nothing
/// of what is everywhere. `pose`, when not null, stands for the region's own. `frustum_length` is where a
/// frustum without a far end is cut.
std::vector<Segment> outline(const client::RegionInfo& region, const RegionPose* pose, double frustum_length);

} // namespace slod::view
