#pragma once

#include "gravity/force_view.hpp"
#include "gravity/target_runs.hpp"

namespace slod {

/// Decides for one group of targets which nodes may act on it as one body. A node of radius r whose centre is
/// at distance d from the group's box may when r <= 0.9 d, without which a dense clump beside the centre of
/// mass would be missed (Dehnen 2014, Computational Astrophysics and Cosmology 1, 1), and
///  - geometric: r <= opening_angle d, or
///  - relative: G m r^2 / (d^2 + q)^2 <= force_tolerance |a|, what a monopole misses at most but for a factor
///    near 1 (Springel 2005, MNRAS 364, 1105; there without softening, which costs a tenth more nodes).
/// Where a node's bodies differ in softening, what their mean misses is held to the same bound.
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

    bool acts_as_one(const ForceView::Node& node) const
    {
        const double squared = distance_squared(node);
        const double radius = double(node.radius), blur = double(node.blur);
        const double softened = squared + node.q;
        if (!relative_)
            return radius * radius <= angle_squared_ * squared && blur * blur <= angle_squared_ * softened;
        const double blur_squared = blur * blur;
        return radius * radius <= guard * guard * squared &&
               node.mass * radius * radius <= allowed_ * softened * softened &&
               node.mass * blur_squared * blur_squared <= allowed_ * softened * softened * softened;
    }

private:
    double distance_squared(const ForceView::Node& node) const
    {
        return (lower_ - node.centre).cwiseMax(node.centre - upper_).cwiseMax(0.0).squaredNorm();
    }
    double gross_pull(const ForceView& view, const TargetRun& group) const;

    Vector3d lower_, upper_; ///< box of the group
    double angle_squared_;
    bool relative_ = false;
    double allowed_ = 0; ///< error of one node's pull over G
};

} // namespace slod
