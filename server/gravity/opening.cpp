#include "gravity/opening.hpp"

#include <algorithm>
#include <limits>

namespace slod {
namespace {

constexpr double least_share = 0.05; ///< of the gross pull

/// Bounds that nothing keeps, and that everything does.
constexpr double none = std::numeric_limits<double>::quiet_NaN(), any = std::numeric_limits<double>::max();

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

simd::OpeningTerms<double> far_terms(const ForceView::Node& targets, const GravitySettings& gravity,
                                     const Allowance& allowance)
{
    simd::OpeningTerms<double> terms{};
    terms.reach = double(targets.radius);
    terms.q = targets.q;
    terms.q_spread = double(targets.q_spread);
    terms.guard = terms.far_guard = terms.most_blur = none;
    terms.point_error = terms.extended_error = none;
    terms.error = allowance.error;
    terms.far_error = 2 * allowance.error;
    if (gravity.multipoles == Multipoles::Quadrupole && allowance.relative && terms.reach > 0)
        terms.far_guard = opening_guard * opening_guard;
    return terms;
}

simd::OpeningTerms<double> opening_terms(const ForceView& view, const ForceView::Node& targets,
                                         const GravitySettings& gravity, const Allowance& allowance)
{
    simd::OpeningTerms<double> terms = far_terms(targets, gravity, allowance);
    const Corners corners = corners_of(view, targets);
    for (int axis = 0; axis < 3; ++axis) {
        terms.lower[axis] = corners.lower[axis] - targets.centre[axis];
        terms.upper[axis] = corners.upper[axis] - targets.centre[axis];
    }
    const bool extended = gravity.multipoles == Multipoles::Quadrupole;
    if (allowance.relative) {
        terms.guard = opening_guard * opening_guard;
        terms.most_blur = any;
        terms.point_error = extended ? 0.5 * allowance.error : allowance.error;
        terms.extended_error = extended ? 4 * allowance.error : none;
    } else {
        const double angle = std::min(gravity.opening_angle, opening_guard);
        terms.guard = terms.most_blur = angle * angle;
        terms.error = any;
        terms.point_error = extended ? none : any;
        terms.extended_error = any;
    }
    return terms;
}

} // namespace slod
