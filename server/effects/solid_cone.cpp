#include <algorithm>
#include <cmath>

#include "effects/solid.hpp"

namespace slod {
namespace {

/// In the half plane of depth along the axis and distance from it, the cone is a triangle: apex, centre of
/// the base and rim.
class Cone final : public Solid {
public:
    explicit Cone(const ColliderSettings& settings)
        : apex_(settings.position), height_(settings.axis.norm()), radius_(settings.radius),
          axis_(settings.axis / height_), side_(across(axis_)),
          slant_(std::sqrt(height_ * height_ + radius_ * radius_))
    {}

    Surface surface(const Vector3d& x) const override
    {
        const Vector3d away = x - apex_;
        const double depth = axis_.dot(away);
        const Vector3d off_axis = away - depth * axis_;
        const double off = off_axis.norm();
        const Vector3d outward = off > 0 ? Vector3d(off_axis / off) : side_;
        const auto seen = [&](double distance, double along, double out) {
            return Surface{distance, along * axis_ + out * outward};
        };
        // Where the mantle's nearest point is between apex (0) and rim (1), and how far outside of it.
        const double down = (depth * height_ + off * radius_) / (slant_ * slant_);
        const double off_mantle = (off * height_ - depth * radius_) / slant_;
        const double below = depth - height_;
        if (down <= 0)
            return corner(seen, depth, off);
        if (off_mantle > 0 && down <= 1)
            return seen(off_mantle, -radius_ / slant_, height_ / slant_);
        if (below > 0 && off <= radius_)
            return seen(below, 1, 0);
        if (off_mantle > 0 || below > 0)
            return corner(seen, below, off - radius_);
        return below > off_mantle ? seen(below, 1, 0) : seen(off_mantle, -radius_ / slant_, height_ / slant_);
    }

    Box bounds() const override
    {
        const Vector3d base = apex_ + height_ * axis_;
        const Vector3d reach = radius_ * (1 - axis_.array().square()).max(0.0).sqrt();
        return {apex_.cwiseMin(base - reach), apex_.cwiseMax(base + reach)};
    }

private:
    /// The apex or the rim is nearest, `along` and `out` away. On the apex the normal is the axis.
    template <class Seen>
    static Surface corner(const Seen& seen, double along, double out)
    {
        const double distance = std::sqrt(along * along + out * out);
        return distance > 0 ? seen(distance, along / distance, out / distance) : seen(0, -1, 0);
    }

    Vector3d apex_;
    double height_, radius_;
    Vector3d axis_; ///< unit vector from apex to base
    Vector3d side_; ///< across it
    double slant_;  ///< from apex to rim
};

Problems cone_problems(const ColliderSettings& settings)
{
    Problems found = radius_problems(settings);
    for (const std::string& problem : axis_problems(settings))
        found.push_back(problem);
    return found;
}

std::unique_ptr<Solid> make_cone(const ColliderSettings& settings)
{
    return std::make_unique<Cone>(settings);
}

} // namespace

const SolidKind cone_kind{.problems = cone_problems, .make = make_cone, .radius = true, .axis = true};

} // namespace slod
