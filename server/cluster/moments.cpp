#include "cluster/moments.hpp"

#include <algorithm>
#include <cmath>

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
    return {moments.oo.matrix() - moments.weight * o * o.transpose(),
            moments.ww.matrix() - moments.weight * w * w.transpose(),
            moments.ow - moments.weight * o * w.transpose()};
}

/// sum of weight (P o + R w)(P o + R w)^T
Matrix3d mapped_square(const CentralMoments& sums, const Matrix3d& p, const Matrix3d& r)
{
    const Matrix3d mixed = p * sums.ow * r.transpose();
    return p * sums.oo * p.transpose() + mixed + mixed.transpose() + r * sums.ww * r.transpose();
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
    return {mapped_square(sums, map.a, map.b), mapped_square(sums, map.c, map.d),
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
    return Symmetric3::of(mapped_square(central(moments), map.a, map.b));
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
