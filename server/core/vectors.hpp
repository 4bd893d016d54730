#pragma once

#include <Eigen/Core>

namespace slod {

using Vector3d = Eigen::Vector3d;
using Vector3f = Eigen::Vector3f;
using Matrix3d = Eigen::Matrix3d;
using Matrix3f = Eigen::Matrix3f;

/// A symmetric 3x3 matrix by its six independent entries.
struct Symmetric3 {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    double trace() const { return xx + yy + zz; }

    Matrix3d matrix() const
    {
        Matrix3d full;
        full << xx, xy, xz, xy, yy, yz, xz, yz, zz;
        return full;
    }

    Symmetric3& operator+=(const Symmetric3& other)
    {
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        return *this;
    }

    friend Symmetric3 operator*(double factor, const Symmetric3& m)
    {
        return {factor * m.xx, factor * m.xy, factor * m.xz, factor * m.yy, factor * m.yz, factor * m.zz};
    }

    /// weight v v^T
    static Symmetric3 square(double weight, const Vector3d& v)
    {
        const Vector3d weighted = weight * v;
        return {weighted.x() * v.x(), weighted.x() * v.y(), weighted.x() * v.z(),
                weighted.y() * v.y(), weighted.y() * v.z(), weighted.z() * v.z()};
    }

    static Symmetric3 of(const Matrix3d& m) { return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}; }
};

} // namespace slod
