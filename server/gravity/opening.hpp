#pragma once

#include <cmath>
#include <cstdint>

#include "gravity/force_view.hpp"
#include "gravity/target_runs.hpp"

namespace slod {

/// How a node acts on a group of targets.
enum class NodeRole : std::uint8_t {
    Opened,   ///< not at all: its parts do
    Point,    ///< as one body
    Extended, ///< as one body with second moments
};

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
/// The |a| of a group is its smallest, but no less than a twentieth of what the same nodes would exert if
/// they all pulled one way: else a group at a centre of symmetry opens everything. A share of the mean |a|
/// instead bounds the errors of no body far out, and in the middle of a homogeneous ball opens a fifth of it.
///
/// Measured in place of r and found worse at equal cost, by a fifth of the error in a sphere and a third in a
/// disc: the bodies' root mean square distance, with and without a factor d^2 / (d - r)^2 for higher moments.
class Opening {
public:
    static constexpr double guard = 0.9;

    /// `pulls` holds |a| of the last evaluation, by slot; 0: none is known. A group with such a body asks for
    /// the geometric criterion.
    Opening(const ForceView& view, const TargetRun& group, const GravitySettings& gravity,
            double gravitational_constant, const AlignedVector<double>& pulls);

    NodeRole role_of(const ForceView::Node& node) const
    {
        const double squared = distance_squared(node);
        const double radius = double(node.radius), blur = double(node.blur);
        const double softened = squared + node.q;
        if (!relative_)
            return radius * radius <= angle_squared_ * squared && blur * blur <= angle_squared_ * softened
                       ? accepted_
                       : NodeRole::Opened;
        const double blur_squared = blur * blur;
        if (radius * radius > guard * guard * squared ||
            node.mass * blur_squared * blur_squared > allowed_ * softened * softened * softened)
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
               node.mass * square * square <= 4 * allowed_ * softened * softened * softened &&
               node.mass * radius * blur * blur <= allowed_ * softened * softened * std::sqrt(softened);
    }
    double gross_pull(const ForceView& view, const TargetRun& group) const;

    Vector3d lower_, upper_; ///< box of the group
    double angle_squared_;
    NodeRole accepted_; ///< of nodes that act as one body
    bool relative_ = false;
    double allowed_ = 0;           ///< error of one node's pull over G
    double allowed_of_points_ = 0; ///< where it acts as a point
};

} // namespace slod
