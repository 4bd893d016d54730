#include "cluster/moments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace slod {
namespace {

/// Sums about the means instead of about the forming centre.
struct CentralMoments {
    Matrix3d oo, ww, ow;
};

CentralMoments central(const Moments& moments)
{
    const Vector3d o = moments.mean_offset();
    const Vector3d w = moments.mean_velocity();
    Symmetric3 oo = moments.oo, ww = moments.ww;
    oo += Symmetric3::square(-moments.weight, o);
    ww += Symmetric3::square(-moments.weight, w);
    const Vector3d weighted = moments.weight * o;
    Matrix3d ow;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        ow.col(axis) = moments.ow.col(axis) - w[axis] * weighted;
    return {oo.matrix(), ww.matrix(), ow};
}

/// sum of weight (P o + R w)(P o + R w)^T. Row by row: products of whole matrices take twice as long here.
Symmetric3 mapped_square(const CentralMoments& sums, const Matrix3d& p, const Matrix3d& r)
{
    const std::array<Vector3d, 3> ps{p.row(0), p.row(1), p.row(2)}, rs{r.row(0), r.row(1), r.row(2)};
    const Matrix3d wo = sums.ow.transpose();
    std::array<Vector3d, 3> os, ws; // sums of weight (P o + R w)_i o, and w
    for (std::size_t i = 0; i < 3; ++i) {
        os[i] = sums.oo * ps[i] + sums.ow * rs[i];
        ws[i] = wo * ps[i] + sums.ww * rs[i];
    }
    const auto entry = [&](std::size_t i, std::size_t j) { return os[i].dot(ps[j]) + ws[i].dot(rs[j]); };
    return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/// The traces of CentralMoments, without the matrices.
struct CentralTraces {
    double oo, ww, ow;
};

CentralTraces central_traces(const Moments& moments)
{
    const double per_weight = moments.weight > 0 ? 1 / moments.weight : 0;
    return {moments.oo.trace() - per_weight * moments.o.squaredNorm(),
            moments.ww.trace() - per_weight * moments.w.squaredNorm(),
            moments.ow.trace() - per_weight * moments.o.dot(moments.w)};
}

/// e with e_i = m_jk - m_kj, i, j, k cyclic: of the sum of x y^T, that of x x y.
Vector3d antisymmetric(const Matrix3d& m)
{
    return {m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0)};
}

} // namespace

MappedMoments map_moments(const Moments& moments, const MapBlocks& map)
{
    const CentralMoments sums = central(moments);
    return {mapped_square(sums, map.a, map.b).matrix(), mapped_square(sums, map.c, map.d).matrix(),
            map.a * sums.oo * map.c.transpose() + map.a * sums.ow * map.d.transpose() +
                map.b * sums.ow.transpose() * map.c.transpose() + map.b * sums.ww * map.d.transpose()};
}

InnerMotion inner_motion(const Moments& moments, const MapBlocks& map)
{
    const MappedMoments mapped = map_moments(moments, map);
    return {antisymmetric(mapped.cross), mapped.velocity.trace()};
}

InnerMotion scalar_inner_motion(const Moments& moments, const MapBlocks& map)
{
    const double a = map.a(0, 0), b = map.b(0, 0), c = map.c(0, 0), d = map.d(0, 0);
    const CentralTraces sums = central_traces(moments);
    const Vector3d spin = antisymmetric(moments.ow) - moments.o.cross(moments.mean_velocity());
    return {(a * d - b * c) * spin, c * c * sums.oo + 2 * c * d * sums.ow + d * d * sums.ww};
}

Symmetric3 map_position_moments(const Moments& moments, const MapBlocks& map)
{
    return mapped_square(central(moments), map.a, map.b);
}

double streamed_trace(const Moments& moments, double drift)
{
    const CentralTraces sums = central_traces(moments);
    return sums.oo + drift * (2 * sums.ow + drift * sums.ww);
}

double breadth(const Symmetric3& second_moments, double weight)
{
    if (!(weight > 0))
        return 0;
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    // Not computeDirect(): its sines differ in the last bit from processor to processor.
    solver.compute(second_moments.matrix() / weight, Eigen::EigenvaluesOnly);
    return 2 * std::sqrt(5 * std::max(solver.eigenvalues()(2), 0.0));
}

} // namespace slod
