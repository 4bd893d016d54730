#pragma once

#include "cluster/flow_map.hpp"
#include "core/vectors.hpp"

namespace slod {

/// Weighted sums over a cluster's members of what was stored at their forming, offset o and relative
/// velocity w. With mass as weight they give everything about the cluster that its map can carry, without
/// visiting a member; with weight 1 its extent as seen.
struct Moments {
    double weight = 0;              ///< sum of weights: the mass, or the count
    Vector3d o{0, 0, 0};            ///< sum of weight o
    Vector3d w{0, 0, 0};            ///< sum of weight w
    Symmetric3 oo;                  ///< Q: sum of weight o o^T
    Symmetric3 ww;                  ///< W: sum of weight w w^T
    Matrix3d ow = Matrix3d::Zero(); ///< S: sum of weight o w^T

    /// Adds a member.
    void add(double member_weight, const Vector3d& offset, const Vector3d& velocity)
    {
        weight += member_weight;
        o += member_weight * offset;
        w += member_weight * velocity;
        oo += Symmetric3::square(member_weight, offset);
        ww += Symmetric3::square(member_weight, velocity);
        ow += member_weight * offset * velocity.transpose();
    }

    Vector3d mean_offset() const { return weight > 0 ? Vector3d(o / weight) : Vector3d(0, 0, 0); }
    Vector3d mean_velocity() const { return weight > 0 ? Vector3d(w / weight) : Vector3d(0, 0, 0); }
};

/// Second moments about the means, mapped to now: sums, not yet divided by the weight.
struct MappedMoments {
    Matrix3d position; ///< sum of weight dx dx^T
    Matrix3d velocity; ///< sum of weight dv dv^T
    Matrix3d cross;    ///< sum of weight dx dv^T
};

MappedMoments map_moments(const Moments& moments, const MapBlocks& map);

/// What the mapped moments say of the motion inside a cluster.
struct InnerMotion {
    Vector3d spin{0, 0, 0}; ///< sum of weight dx x dv
    double square = 0;      ///< sum of weight |dv|^2
};
InnerMotion inner_motion(const Moments& moments, const MapBlocks& map);

/// The same in a few multiplications, for a map whose blocks are multiples of the identity.
InnerMotion scalar_inner_motion(const Moments& moments, const MapBlocks& map);

/// The position part of map_moments alone, which is what a frame needs.
Symmetric3 map_position_moments(const Moments& moments, const MapBlocks& map);

/// The trace of map_position_moments for a scalar map, A = 1 and B = `drift`, in a few multiplications.
double streamed_trace(const Moments& moments, double drift);

/// Diameter of the homogeneous ball with the largest principal variance of `second_moments / weight`.
double breadth(const Symmetric3& second_moments, double weight);

} // namespace slod
