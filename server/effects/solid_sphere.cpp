#include "effects/solid.hpp"

namespace slod {
namespace {

class Ball final : public Solid {
public:
    explicit Ball(const ColliderSettings& settings) : centre_(settings.position), radius_(settings.radius) {}

    Surface surface(const Vector3d& x) const override
    {
        const Vector3d away = x - centre_;
        const double length = away.norm();
        return {length - radius_, length > 0 ? Vector3d(away / length) : Vector3d(0, 0, 1)};
    }

    Box bounds() const override { return box_around(centre_, centre_, radius_); }

private:
    Vector3d centre_;
    double radius_;
};

std::unique_ptr<Solid> make_sphere(const ColliderSettings& settings)
{
    return std::make_unique<Ball>(settings);
}

} // namespace

const SolidKind sphere_kind{.problems = radius_problems, .make = make_sphere, .radius = true};

} // namespace slod
