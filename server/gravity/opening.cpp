#include "gravity/opening.hpp"

#include <algorithm>
#include <limits>

namespace slod {
namespace {

constexpr double least_share = 0.05; ///< of the gross pull

struct Corners {
    Vector3d lower, upper;
};

/// Of the box around a node's bodies.
Corners corners_of(const ForceView& view, const ForceView::Node& node)
{
    Corners corners{view.position(node.first), view.position(node.first)};
    for (std::uint32_t body = node.first; body < node.first + node.count; ++body) {
        corners.lower = corners.lower.cwiseMin(view.position(body));
        corners.upper = corners.upper.cwiseMax(view.position(body));
    }
    return corners;
}

} // namespace

Allowance allowance_for(const ForceView& view, const ForceView::Node& targets, const GravitySettings& gravity,
                        double gravitational_constant, const AlignedVector<double>& pulls, double gross_pull)
{
    if (gravity.opening != OpeningCriterion::Relative)
        return {};
    double smallest = std::numeric_limits<double>::infinity();
    for (std::uint32_t body = targets.first; body < targets.first + targets.count; ++body)
        smallest = std::min(smallest, pulls[view.slot[body].index]);
    if (!(smallest > 0))
        return {};
    return {true,
            gravity.force_tolerance * std::max(smallest / gravitational_constant, least_share * gross_pull)};
}

double gross_pull(const ForceView& view, const ForceView::Node& targets, std::uint32_t region)
{
    double sum = 0;
    for (std::size_t source = 0; source < view.regions.size(); ++source) {
        if (!view.acts(source, region))
            continue;
        const ForceView::Region& acting = view.regions[source];
        for (std::uint32_t index = acting.first_node; index < acting.last_node;) {
            const ForceView::Node& node = view.nodes[index];
            const double squared = (node.centre - targets.centre).squaredNorm();
            const double size = double(node.radius) + double(targets.radius);
            const bool far = size * size <= opening_guard * opening_guard * squared;
            if (far)
                sum += node.mass / (squared + node.q);
            index = far || node.count <= targets.count ? node.next : index + 1;
        }
    }
    return sum;
}

Opening::Opening(const ForceView& view, const ForceView::Node& targets, const GravitySettings& gravity,
                 const Allowance& allowance)
    : targets_(targets), allowance_(allowance),
      angle_squared_(std::min(gravity.opening_angle, opening_guard) *
                     std::min(gravity.opening_angle, opening_guard)),
      accepted_(gravity.multipoles == Multipoles::Quadrupole ? NodeRole::Extended : NodeRole::Point),
      allowed_of_points_(accepted_ == NodeRole::Extended ? 0.5 * allowance.error : allowance.error)
{
    const Corners corners = corners_of(view, targets);
    lower_ = corners.lower;
    upper_ = corners.upper;
}

} // namespace slod
