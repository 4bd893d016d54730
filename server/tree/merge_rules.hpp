#pragma once

#include <cstdint>

#include "cluster/forming.hpp"
#include "tree/settings.hpp"

namespace slod {

/// The velocities of a cluster's members: in a ball about the mean.
struct VelocityBall {
    Vector3d mean{0, 0, 0}; ///< scene length / time
    double speed = 0;       ///< of the mean
    double radius = 0;      ///< no member's velocity is farther from the mean
};

/// Relative to the velocity `reference`.
VelocityBall velocity_ball(const ClusterStore& store, std::size_t slot, std::uint64_t frame,
                           const Vector3d& reference);

/// The smallest ball that holds both.
VelocityBall enclosing_ball(const VelocityBall& a, const VelocityBall& b);

/// Particles as their number and places have it, all weighing the same.
struct Crowd {
    double number = 0;
    Vector3d centre{0, 0, 0};
    Matrix3d moments = Matrix3d::Zero(); ///< of position about the centre, summed
};

Crowd crowd_of(const ClusterStore& store, std::size_t slot, std::uint64_t frame);

/// Both as one.
Crowd operator+(const Crowd& a, const Crowd& b);

/// A region's rules for clusters that become one (O'Brien et al. 2001, section 4.1), ready for many: together
/// no wider than the maximum breadth, and speeds and directions within its limits. Those hold for any member
/// of one and any of the other, not only for their means, so that a chain of merges cannot exceed them,
/// unless merged velocities collapse: then members have no others than earlier merges have left them. Below
/// the speed floor they are not asked for.
class MergeRules {
public:
    explicit MergeRules(const RegionSettings& region);

    /// Whether every velocity in one ball is within the limits of speed and angle to every one in the other.
    /// Parallel velocities are within any angle, whatever their rounding.
    bool move_alike(const VelocityBall& a, const VelocityBall& b) const;

    /// Whether the breadth of a cluster has a limit: without one, any crowd fits.
    bool limit_breadth() const;

    /// Whether no cluster is wider than the region allows when the crowd is divided into `parts` of equal
    /// number, however that is done.
    bool fit(const Crowd& crowd, std::uint32_t parts = 1) const;

private:
    const RegionSettings& region_;
    double least_cosine_; ///< of the angle
};

/// Whether the velocities of any two of its members are within the region's limits to each other: never true
/// falsely, but false of some whose ball is wider than what is in it. That of two equal bodies 29.9 degrees
/// apart is 31 degrees wide, though the two may merge.
bool moves_alike(const ClusterStore& store, const RegionSettings& region, ClusterSlot slot,
                 std::uint64_t frame, const Vector3d& reference = {0, 0, 0});

/// Whether the cluster is to be split: wider than its region allows or, in rigid motion, drifted too far
/// apart by its members' own velocities. Size and breadth are goals: a cluster of nearly the maximum size
/// may be a quarter wider in its first 60 frames.
bool too_wide(const ClusterStore& store, const RegionSettings& region, ClusterSlot slot, std::uint64_t frame);

/// Whether a cluster of `size` particles and `second_moments` (summed, not averaged) is wider than `limit`.
bool wider_than(double limit, const Symmetric3& second_moments, double size);

} // namespace slod
