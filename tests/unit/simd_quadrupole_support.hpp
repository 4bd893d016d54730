#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "simd/kernels.hpp"
#include "unit/simd_gravity_support.hpp"

// Nodes with second moments, and what the kernels make of them.
namespace slod::simd {

inline constexpr std::size_t sum_count = 9; ///< three of the acceleration, six of the tide
inline constexpr std::array<std::array<std::size_t, 3>, 3> entry = {{{3, 4, 5}, {4, 6, 7}, {5, 7, 8}}};

/// Columns of targets or of nodes: x, y, z, q, and of nodes mass, the six moments and their trace.
enum Column : std::size_t { X, Y, Z, Q, Mass, Xx, Xy, Xz, Yy, Yz, Zz, Trace, column_count };

template <class Real>
struct Rows {
    std::array<std::vector<Real>, column_count> columns;

    std::size_t count() const { return columns[X].size(); }
    const Real* data(Column column) const { return columns[column].data(); }

    void add(const std::array<double, column_count>& row)
    {
        for (std::size_t column = 0; column < column_count; ++column)
            columns[column].push_back(Real(row[column]));
    }

    GravityNodes<Real> nodes() const
    {
        return {{count(), data(X), data(Y), data(Z), data(Mass), data(Q)},
                data(Xx),
                data(Xy),
                data(Xz),
                data(Yy),
                data(Yz),
                data(Zz),
                data(Trace)};
    }
};

struct PointMass {
    std::array<double, 3> offset; ///< from the centre of mass
    double mass;
};

/// The node that these are, with its centre of mass there.
inline std::array<double, column_count> node_of(const std::vector<PointMass>& points,
                                                const std::array<double, 3>& centre, double q)
{
    std::array<double, column_count> row{centre[0], centre[1], centre[2], q};
    for (const PointMass& point : points)
        row[Mass] += point.mass;
    for (const PointMass& point : points) {
        const double share = 3 * point.mass / row[Mass];
        std::size_t moment = Xx;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = i; j < 3; ++j)
                row[moment++] += share * point.offset[i] * point.offset[j];
    }
    row[Trace] = 0.5 * (row[Xx] + row[Yy] + row[Zz]);
    return row;
}

/// Three masses of 1/2 to 3/2 that reach `size` from their centre of mass, about.
inline std::vector<PointMass> random_points(std::mt19937_64& bits, double size)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<PointMass> points(3);
    std::array<double, 3> centre{};
    double mass = 0;
    for (PointMass& point : points) {
        point.mass = 1 + 0.5 * uniform(bits);
        mass += point.mass;
        for (std::size_t i = 0; i < 3; ++i) {
            point.offset[i] = size * uniform(bits);
            centre[i] += point.mass * point.offset[i];
        }
    }
    for (PointMass& point : points)
        for (std::size_t i = 0; i < 3; ++i)
            point.offset[i] -= centre[i] / mass;
    return points;
}

template <class Real>
using NodeSums = std::array<std::vector<Real>, sum_count>;

template <class Real>
NodeSums<Real> evaluate_nodes(const KernelTable& table, const Rows<Real>& targets,
                              const GravityNodes<Real>& nodes, bool tide = true)
{
    NodeSums<Real> sums;
    for (std::vector<Real>& sum : sums)
        sum.assign(targets.count(), 0);
    GravityTargets<Real> pulled{targets.count(), targets.data(X), targets.data(Y), targets.data(Z),
                                targets.data(Q), sums[0].data(),  sums[1].data(),  sums[2].data(),
                                sums[3].data(),  sums[4].data(),  sums[5].data(),  sums[6].data(),
                                sums[7].data(),  sums[8].data()};
    const GravityKernels<Real>& kernels = gravity_kernels<Real>(table);
    if (tide) {
        kernels.add_nodes_acceleration_and_tide(pulled, nodes);
    } else {
        pulled.txx = pulled.txy = pulled.txz = pulled.tyy = pulled.tyz = pulled.tzz = nullptr;
        kernels.add_nodes_acceleration(pulled, nodes);
    }
    return sums;
}

} // namespace slod::simd
