#pragma once

#include <cmath>
#include <cstdint>

#include "gravity/far_field.hpp"
#include "gravity/force_view.hpp"
#include "gravity/target_runs.hpp"

namespace slod {

/// How a node acts on a group of targets.
enum class NodeRole : std::uint8_t {
    Opened,   ///< not at all: its parts do
    Point,    ///< as one body
    Extended, ///< as one body with second moments
    Far,      ///< the same, by an expansion about the targets' middle
};

/// Error that targets allow of the pull of a single node.
struct Allowance {
    bool relative = false; ///< where not, none is known: the geometric criterion decides
    double error = 0;      ///< over G: mass / length^2
};

/// Of the bodies below a node: force_tolerance of the smallest of their accelerations in the last evaluation
/// (`pulls`, by slot; 0: none is known), but of no less than a twentieth of their gross pull.
Allowance allowance_for(const ForceView& view, const ForceView::Node& targets, const GravitySettings& gravity,
                        double gravitational_constant, const AlignedVector<double>& pulls, double gross_pull);

/// What all nodes would exert on the bodies below a node if they pulled one way, over G, by nodes as coarse
/// as the guard allows; without the nearest bodies.
double gross_pull(const ForceView& view, const ForceView::Node& targets, std::uint32_t region);

/// Largest radius of a node that acts as one body, of its distance.
inline constexpr double opening_guard = 0.9;

/// Whether a node may act on the bodies below `targets` by an expansion about their centre: where what an
/// expansion to the third power misses, m s^4 / (d^2 + q)^3 with s the sum of both radii, is no more than
/// twice the allowance, and what bodies of another softening than the targets' mean miss, 3/2 m dq / (d^2 +
/// q)^2, within it. Plummer sphere of 100,000 at tolerance 0.003, for once, twice, 4 and 8 times: 78, 75, 74
/// and 77 ms, 99 % of the errors below 4.4, 4.8, 6.6 and 8.4e-3. Targets in one place need no expansion.
inline bool is_far(const ForceView::Node& node, const ForceView::Node& targets, const Allowance& allowance)
{
    const double squared = (node.centre - targets.centre).squaredNorm();
    const double size = double(node.radius) + double(targets.radius);
    const double square = size * size;
    const double softened = squared + node.q + targets.q;
    const double blur_squared = double(node.blur) * double(node.blur);
    const double allowed = allowance.error * softened * softened;
    return targets.radius * targets.radius > 0 && square <= opening_guard * opening_guard * squared &&
           node.mass * square * square <= 2 * allowed * softened &&
           node.mass * blur_squared * blur_squared <= allowed * softened &&
           1.5 * node.mass * double(targets.q_spread) <= allowed;
}

/// Decides for one group of targets which nodes may act on it as one body. A node of radius r whose centre is
/// at distance d from the group's box may when r <= 0.9 d, without which a dense clump beside the centre of
/// mass would be missed (Dehnen 2014, Computational Astrophysics and Cosmology 1, 1), and
///  - geometric: r <= opening_angle d, or
///  - relative: G m r^2 / (d^2 + q)^2 <= force_tolerance |a|, what a monopole misses at most but for a factor
///    near 1 (Springel 2005, MNRAS 364, 1105; there without softening, which costs a tenth more nodes).
/// Where second moments are asked for
///  - geometric: every node that acts as one body has them;
///  - relative: one that keeps half the bound above acts as a point, and else with its second moments where
///    G m r^4 / (d^2 + q)^3 <= 4 force_tolerance |a| (Springel, Yoshida and White 2001, New Astronomy 6, 79;
///    there without the 4). With r^3 / (d^2 + q)^(3/2), the third moments' bound, errors are the same at
///    equal cost. With the 4 they are below those of monopoles at the default tolerance for every shape
///    tried, with 8 above them for some.
/// Where a node's bodies differ in softening, what their mean misses is held to the same bound; and so is
/// r b^2 of the blur b, which softer bodies on one side make, where r^2 is not.
/// The |a| of a group is its smallest, but no less than a twentieth of what its branch would feel if all
/// nodes pulled one way: else a group at a centre of symmetry opens everything. A share of the mean |a|
/// instead bounds the errors of no body far out, and in the middle of a homogeneous ball opens a fifth of it.
///
/// Measured in place of r and found worse at equal cost, by a fifth of the error in a sphere and a third in a
/// disc: the bodies' root mean square distance, with and without a factor d^2 / (d - r)^2 for higher moments.
class Opening {
public:
    Opening(const ForceView& view, const ForceView::Node& targets, const GravitySettings& gravity,
            const Allowance& allowance);

    NodeRole role_of(const ForceView::Node& node) const
    {
        const double squared = distance_squared(node);
        const double radius = double(node.radius), blur = double(node.blur);
        const double softened = squared + node.q;
        if (!allowance_.relative)
            return radius * radius <= angle_squared_ * squared && blur * blur <= angle_squared_ * softened
                       ? accepted_
                       : NodeRole::Opened;
        if (accepted_ == NodeRole::Extended && is_far(node, targets_, allowance_))
            return NodeRole::Far;
        const double blur_squared = blur * blur;
        if (radius * radius > opening_guard * opening_guard * squared ||
            node.mass * blur_squared * blur_squared > allowance_.error * softened * softened * softened)
            return NodeRole::Opened;
        if (node.mass * radius * radius <= allowed_of_points_ * softened * softened)
            return NodeRole::Point;
        return fits_extended(node, softened) ? NodeRole::Extended : NodeRole::Opened;
    }

private:
    double distance_squared(const ForceView::Node& node) const
    {
        return (lower_ - node.centre).cwiseMax(node.centre - upper_).cwiseMax(0.0).squaredNorm();
    }
    bool fits_extended(const ForceView::Node& node, double softened) const
    {
        const double radius = double(node.radius), blur = double(node.blur);
        const double square = radius * radius;
        return accepted_ == NodeRole::Extended &&
               node.mass * square * square <= 4 * allowance_.error * softened * softened * softened &&
               node.mass * radius * blur * blur <=
                   allowance_.error * softened * softened * std::sqrt(softened);
    }

    const ForceView::Node& targets_;
    Allowance allowance_;
    Vector3d lower_, upper_; ///< box of the targets
    double angle_squared_;
    NodeRole accepted_;            ///< of nodes that act as one body
    double allowed_of_points_ = 0; ///< error of one that acts as a point
};

} // namespace slod
