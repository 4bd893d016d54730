#pragma once

#include <cstddef>
#include <cstdint>

// Plain data only: this header goes into files built for newer processors, and of an inline function
// in it the linker might keep, for the whole program, the copy made for a processor we lack.
namespace slod::simd {

/// Targets come in multiples of this many, so that no kernel has a tail loop. The caller puts any finite
/// places and softenings after the last target; sums are added there too, and mean nothing.
inline constexpr std::size_t tile_width = 16;

/// The kernels' `self` when no body is among both the targets and the sources.
inline constexpr std::ptrdiff_t no_self = PTRDIFF_MIN;

/// Bodies that are attracted. The sums are *added to*, so a list of sources may come in pieces.
/// Arrays have padded_count elements, need no alignment, and those written overlap no other.
template <class Real>
struct GravityTargets {
    std::size_t padded_count;                ///< a multiple of tile_width
    const Real *x, *y, *z;                   ///< length; targets and sources share an origin, near both
    const Real* q;                           ///< half the squared softening, length^2, >= 0
    Real *ax, *ay, *az;                      ///< acceleration / G, mass / length^2
    Real *txx, *txy, *txz, *tyy, *tyz, *tzz; ///< tide / G, mass / length^3; null when none is asked for
};

/// Bodies whose potential is asked for; otherwise as GravityTargets.
template <class Real>
struct PotentialTargets {
    std::size_t padded_count; ///< a multiple of tile_width
    const Real *x, *y, *z;    ///< length
    const Real* q;            ///< half the squared softening, length^2, >= 0
    Real* potential;          ///< potential / G, mass / length
};

/// Bodies that attract. They need no padding and no alignment.
template <class Real>
struct GravitySources {
    std::size_t count;
    const Real *x, *y, *z; ///< length
    const Real* mass;
    const Real* q; ///< half the squared softening, length^2, >= 0
};

/// Nodes of a tree that attract by their second moments too: S = sum m o o^T over a node's bodies, o their
/// offsets from its centre of mass, none longer than their distance from any target.
template <class Real>
struct GravityNodes : GravitySources<Real> {
    const Real *xx, *xy, *xz, *yy, *yz, *zz; ///< 3 S / m, length^2
    const Real* trace;                       ///< half of theirs
};

/// How a node of a tree acts on a group of targets.
enum class NodeRole : std::uint8_t {
    Opened,   ///< not at all: its parts do
    Point,    ///< as one body
    Extended, ///< as one body with second moments
    Far,      ///< the same, by an expansion about the targets' middle
};

/// Nodes whose roles are asked for. Arrays have padded_count elements and need no alignment.
template <class Real>
struct NodesInQuestion {
    std::size_t padded_count; ///< a multiple of tile_width
    const Real *x, *y, *z;    ///< length, from the targets' centre
    const Real* mass;
    const Real* q;      ///< half the squared softening, length^2, >= 0
    const Real* radius; ///< length
    const Real* blur;   ///< length: what the softenings of its bodies differ by
};

/// What decides on the roles of nodes for one group of targets. With d the distance from the targets' box, t
/// = d^2 + q, radius r and blur b a node acts as one body where
///  - r^2 <= guard d^2, b^2 <= most_blur t and m b^4 <= error t^3,
/// and then as a Point where m r^2 <= point_error t^2, or else, Extended, where
///  - m r^4 <= extended_error t^3 and m r b^2 <= error t^(5/2).
/// It is Far where, with d from the targets' centre, t = d^2 + q + q of the targets and s = r + reach,
///  - s^2 <= far_guard d^2, m s^4 <= far_error t^3, m b^4 <= error t^3 and 3/2 m q_spread <= error t^2.
/// NaN excludes a role.
template <class Real>
struct OpeningTerms {
    Real lower[3], upper[3]; ///< box of the targets, from their centre
    Real reach;              ///< their radius, length
    Real q;                  ///< half their squared softening, in the mean
    Real q_spread;           ///< what theirs differ by at most, length^2
    Real guard, far_guard, most_blur;
    Real error, point_error, extended_error, far_error; ///< acceleration / G: mass / length^2
};

/// Places of a symmetric tensor's entries among those listed below: of a matrix by row and column, and of the
/// next rank by an entry of the rank before and one more index.
namespace Entry {
constexpr std::size_t of2[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
constexpr std::size_t of3[6][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}, {3, 6, 7}, {4, 7, 8}, {5, 8, 9}};
constexpr std::size_t of4[10][3] = {{0, 1, 2}, {1, 3, 4},   {2, 4, 5},   {3, 6, 7},   {4, 7, 8},
                                    {5, 8, 9}, {6, 10, 11}, {7, 11, 12}, {8, 12, 13}, {9, 13, 14}};
} // namespace Entry

/// What far nodes do about one point, the origin, where targets of one softening are. With d from there to a
/// node, r^2 = |d|^2 + q_target + q_node, n = d / r, R = `reach` and p = m / r^2, sums over the nodes of
///  - FarTerm::Pull     the acceleration at the origin, with the second moments' share: 3 terms,
///  - FarTerm::Tide     R times the tide there, with theirs: xx, xy, xz, yy, yz, zz,
///  - FarTerm::Third    p (R/r)^2 n n n: xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz,
///  - FarTerm::Fifth    p (R/r)^2 n: 3 terms,
///  - FarTerm::Fourth   p (R/r)^3 n n n n: x times those of Third, then yyyy, yyyz, yyzz, yzzz, zzzz,
///  - FarTerm::Sixth    p (R/r)^3 n n: as Tide,
///  - FarTerm::Seventh  p (R/r)^3.
/// None exceeds the nodes' pulls while R is less than any r.
namespace FarTerm {
enum : std::size_t {
    Pull = 0,
    Tide = 3,
    Third = 9,
    Fifth = 19,
    Fourth = 22,
    Sixth = 37,
    Seventh = 43,
    count
};
}

template <class Real>
struct FarPoint {
    Real q;      ///< half the squared softening of the targets, length^2, >= 0
    Real reach;  ///< length that the terms are made accelerations with
    Real* terms; ///< FarTerm::count runs of tile_width partial sums, added to
};

/// The acceleration near an origin, to the third power of the offset y = x / reach, as terms of Taylor's
/// series: a = pull + T y + 1/2 C y y + 1/6 D y y y, each symmetric and an acceleration.
template <class Real>
struct FarExpansion {
    Real reach;      ///< length
    Real pull[3];    ///< x, y, z
    Real tide[6];    ///< xx, xy, xz, yy, yz, zz
    Real third[10];  ///< as FarTerm::Third
    Real fourth[15]; ///< as FarTerm::Fourth
};

/// Gravity in one precision. With d = source - target and r^2 = |d|^2 + q_target + q_source they add
///  - acceleration  sum m d / r^3,
///  - tide          sum m (3 d d^T / r^5 - 1 / r^3), the acceleration's derivative by the target's place,
///  - potential     -sum m / r.
///
/// and of a node's second moments S
///  - acceleration  (15/2 d.S.d / r^7 - 3/2 tr S / r^5) d - 3 S d / r^5,
///  - tide          its derivative.
///
/// Source s and target t are the same body, and no pair, when s == t + self. Every other pair counts,
/// coincident ones too, but for those with r = 0, which contribute nothing. The caller chooses units so
/// that neither m / r^3 nor any r^3 overflows. Sources are summed in order: all processors compute the same
/// bits.
template <class Real>
struct GravityKernels {
    void (*add_acceleration)(const GravityTargets<Real>&, const GravitySources<Real>&, std::ptrdiff_t self);
    void (*add_acceleration_and_tide)(const GravityTargets<Real>&, const GravitySources<Real>&,
                                      std::ptrdiff_t self);
    void (*add_nodes_acceleration)(const GravityTargets<Real>&, const GravityNodes<Real>&);
    void (*add_nodes_acceleration_and_tide)(const GravityTargets<Real>&, const GravityNodes<Real>&);
    /// The nodes' count is a multiple of tile_width, their arrays aligned or not; those without mass add
    /// nothing.
    void (*add_far_nodes)(const FarPoint<Real>&, const GravityNodes<Real>&);
    /// Writes NodeRole's number for each node.
    void (*find_roles)(const OpeningTerms<Real>&, const NodesInQuestion<Real>&, std::uint8_t* roles);
    /// Tides too where the targets have them.
    void (*add_expansion)(const GravityTargets<Real>&, const FarExpansion<Real>&);
    void (*add_potential)(const PotentialTargets<Real>&, const GravitySources<Real>&, std::ptrdiff_t self);
};

} // namespace slod::simd
