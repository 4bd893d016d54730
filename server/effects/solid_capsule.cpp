#include <algorithm>

#include "effects/solid.hpp"

namespace slod {
namespace {

class Capsule final : public Solid {
public:
    explicit Capsule(const ColliderSettings& settings)
        : end_(settings.position), axis_(settings.axis), radius_(settings.radius)
    {}

    Surface surface(const Vector3d& x) const override
    {
        const double share = std::clamp(axis_.dot(x - end_) / axis_.squaredNorm(), 0.0, 1.0);
        const Vector3d away = x - (end_ + share * axis_);
        const double length = away.norm();
        return {length - radius_, length > 0 ? Vector3d(away / length) : across(axis_)};
    }

    Box bounds() const override { return box_around(end_, end_ + axis_, radius_); }

private:
    Vector3d end_, axis_;
    double radius_;
};

Problems capsule_problems(const ColliderSettings& settings)
{
    Problems found = radius_problems(settings);
    for (const std::string& problem : axis_problems(settings))
        found.push_back(problem);
    return found;
}

std::unique_ptr<Solid> make_capsule(const ColliderSettings& settings)
{
    return std::make_unique<Capsule>(settings);
}

} // namespace

const SolidKind capsule_kind{
    .problems = capsule_problems, .make = make_capsule, .radius = true, .axis = true};

} // namespace slod
