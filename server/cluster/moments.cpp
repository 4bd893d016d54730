#include "cluster/moments.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

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

} // namespace

MappedMoments map_moments(const Moments& moments, const MapBlocks& map)
{
    const CentralMoments sums = central(moments);
    return {mapped_square(sums, map.a, map.b), mapped_square(sums, map.c, map.d),
            map.a * sums.oo * map.c.transpose() + map.a * sums.ow * map.d.transpose() +
                map.b * sums.ow.transpose() * map.c.transpose() + map.b * sums.ww * map.d.transpose()};
}

Symmetric3 map_position_moments(const Moments& moments, const MapBlocks& map)
{
    return Symmetric3::of(mapped_square(central(moments), map.a, map.b));
}

double streamed_trace(const Moments& moments, double drift)
{
    const double per_weight = moments.weight > 0 ? 1 / moments.weight : 0;
    const double oo = moments.oo.trace() - per_weight * moments.o.squaredNorm();
    const double ow = moments.ow.trace() - per_weight * moments.o.dot(moments.w);
    const double ww = moments.ww.trace() - per_weight * moments.w.squaredNorm();
    return oo + drift * (2 * ow + drift * ww);
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
