#include <cmath>

#include "core/number_text.hpp"
#include "effects/solid.hpp"

namespace slod {
namespace {

class Block final : public Solid {
public:
    explicit Block(const ColliderSettings& settings)
        : centre_(settings.position), half_extent_(settings.half_extent), axes_(rotation_of(settings))
    {}

    Surface surface(const Vector3d& x) const override
    {
        const Vector3d away = axes_.transpose() * (x - centre_);
        const Vector3d beyond = away.cwiseAbs() - half_extent_; // of each pair of faces
        const Vector3d outside = beyond.cwiseMax(0.0);
        const double distance = outside.norm();
        if (distance > 0)
            return {distance, axes_ * signed_as(away, outside / distance)};
        int face = 0;
        const double depth = beyond.maxCoeff(&face);
        return {depth, axes_ * signed_as(away, Vector3d::Unit(face))};
    }

    Box bounds() const override
    {
        const Vector3d reach = axes_.cwiseAbs() * half_extent_;
        return {centre_ - reach, centre_ + reach};
    }

private:
    static Vector3d signed_as(const Vector3d& signs, const Vector3d& sizes)
    {
        return {std::copysign(sizes.x(), signs.x()), std::copysign(sizes.y(), signs.y()),
                std::copysign(sizes.z(), signs.z())};
    }

    Vector3d centre_, half_extent_;
    Matrix3d axes_; ///< its own, as columns
};

Problems box_problems(const ColliderSettings& settings)
{
    const Vector3d& half = settings.half_extent;
    if ((half.array() > 0).all())
        return {};
    return {"half_extent = [" + number_text(half.x()) + ", " + number_text(half.y()) + ", " +
            number_text(half.z()) + "] leaves nothing solid; use more than 0 for each."};
}

std::unique_ptr<Solid> make_box(const ColliderSettings& settings)
{
    return std::make_unique<Block>(settings);
}

} // namespace

const SolidKind box_kind{.problems = box_problems, .make = make_box, .half_extent = true, .rotation = true};

} // namespace slod
