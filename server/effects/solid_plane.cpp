#include <limits>

#include "effects/solid.hpp"

namespace slod {
namespace {

/// All that is on the far side of a plane.
class HalfSpace final : public Solid {
public:
    explicit HalfSpace(const ColliderSettings& settings)
        : point_(settings.position), normal_(settings.normal.stableNormalized())
    {}

    Surface surface(const Vector3d& x) const override { return {normal_.dot(x - point_), normal_}; }

    /// Bounded only where the plane lies along the axes.
    Box bounds() const override
    {
        Box box = box_around(point_, point_, std::numeric_limits<double>::infinity());
        for (int axis = 0; axis < 3; ++axis) {
            if (normal_[axis] == 1)
                box.upper[axis] = point_[axis];
            else if (normal_[axis] == -1)
                box.lower[axis] = point_[axis];
        }
        return box;
    }

private:
    Vector3d point_, normal_;
};

Problems plane_problems(const ColliderSettings& settings)
{
    if (settings.normal.squaredNorm() > 0)
        return {};
    return {"normal = [0, 0, 0] has no direction; use one away from what is solid, such as [0, 0, 1]."};
}

std::unique_ptr<Solid> make_plane(const ColliderSettings& settings)
{
    return std::make_unique<HalfSpace>(settings);
}

} // namespace

const SolidKind plane_kind{.problems = plane_problems, .make = make_plane, .normal = true};

} // namespace slod
