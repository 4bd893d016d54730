#pragma once

#include <cstdint>

#include "gravity/force_view.hpp"
#include "simd/gravity_kernels.hpp"

namespace slod {

using simd::NodeRole;

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

/// Terms in units of the scene that name the nodes that may act on the bodies below `targets` by an expansion
/// about their centre: where what an expansion to the third power misses, m s^4 / (d^2 + q)^3 with s the sum
/// of both radii, is no more than twice the allowance, and what bodies of another softening than the targets'
/// mean miss, 3/2 m dq / (d^2 + q)^2, within it. Plummer sphere of 100,000 at tolerance 0.003, for once,
/// twice, 4 and 8 times: 78, 75, 74 and 77 ms, 99 % of the errors below 4.4, 4.8, 6.6 and 8.4e-3. Targets in
/// one place need no expansion, and what has no second moments, or is held by an angle, knows none.
simd::OpeningTerms<double> far_terms(const ForceView::Node& targets, const GravitySettings& gravity,
                                     const Allowance& allowance);

/// The same for all roles, of a group of targets. A node of radius r whose centre is at distance d from the
/// group's box may act as one body when r <= 0.9 d, without which a dense clump beside the centre of mass
/// would be missed (Dehnen 2014, Computational Astrophysics and Cosmology 1, 1), and
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
simd::OpeningTerms<double> opening_terms(const ForceView& view, const ForceView::Node& targets,
                                         const GravitySettings& gravity, const Allowance& allowance);

} // namespace slod
