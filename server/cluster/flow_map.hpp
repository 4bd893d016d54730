#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/vectors.hpp"

namespace slod {

/// What carries a member from its cluster's forming to now.
enum class MapKind : std::uint8_t {
    Identity, ///< nothing: rigid motion, or one particle per cluster
    Scalar,   ///< A = 1, C = 0, B and D closed forms of the age: exact where no field depends on the position
    Full,     ///< four 3x3 blocks, the tangent of every step since forming
};

constexpr std::array<std::string_view, 3> names(MapKind)
{
    return {"identity", "scalar", "full"};
}

/// The tangent of a cluster's motion since it was formed: a member formed at offset o with relative
/// velocity w is now at  X + A o + B w  with velocity  V + C o + D w.  A and D are near 1 for most of a
/// map's life, so their difference from 1 is what is stored.
struct FlowMap {
    Matrix3f a_minus_1 = Matrix3f::Zero();
    Matrix3f b = Matrix3f::Zero(); ///< time
    Matrix3f c = Matrix3f::Zero(); ///< 1 / time
    Matrix3f d_minus_1 = Matrix3f::Zero();
};

/// Whether the map has stretched offsets or relative velocities by so much, eightfold, that what floats round
/// is seen in its members, and that they are far beyond where a first order says where they are.
bool is_worn(const FlowMap& map);

/// Tangent of a kick by `step` in a field with gradient `tide`: v += step * a(x).
void kick(FlowMap& map, double step, const Matrix3d& tide);
inline void kick(FlowMap& map, double step, const Symmetric3& tide)
{
    kick(map, step, tide.matrix());
}

/// The exact flow of one time step in uniform gravity, linear drag and uniform wind, which is affine:
/// x += drift v + shift,  v = decay v + gain.
struct Propagator {
    double decay_minus_1 = 0; ///< exp(-k h) - 1
    double drift = 0;         ///< (1 - exp(-k h)) / k, or h without drag
    Vector3d shift{0, 0, 0};
    Vector3d gain{0, 0, 0};

    /// In the innermost loop of frames without clusters, where a call takes a fifth of the time.
    [[gnu::always_inline]] void apply(Vector3d& position, Vector3d& velocity) const
    {
        position += drift * velocity + shift;
        velocity += decay_minus_1 * velocity + gain;
    }
};

/// Tangent of the propagator.
void propagate(FlowMap& map, const Propagator& step);

/// The tangent of any step, less the identity: x += xx x + xv v, v += vx x + vv v.
struct Tangent {
    Matrix3f xx, xv, vx, vv;
};

void propagate(FlowMap& map, const Tangent& step);

/// The four blocks of any kind of map, in double, and what its inverse needs.
struct MapBlocks {
    Matrix3d a = Matrix3d::Identity();
    Matrix3d b = Matrix3d::Zero();
    Matrix3d c = Matrix3d::Zero();
    Matrix3d d = Matrix3d::Identity();
    /// M^T J M = decay J, as where tides are symmetric and one drag shrinks phase space everywhere alike.
    bool conformal = true;
    double decay = 1; ///< exp(-k age), of conformal maps

    /// An offset in position and in velocity.
    struct Offset {
        Vector3d position, velocity;
    };

    Offset forward(const Offset& formed) const
    {
        return {a * formed.position + b * formed.velocity, c * formed.position + d * formed.velocity};
    }

    /// The offset that forward() carries to `now`: the conformally symplectic inverse
    /// [[D^T, -B^T], [-C^T, A^T]] / decay, sharpened by one step of iterative refinement since the
    /// float map is symplectic to its own rounding only. Of any other map, by elimination.
    Offset inverse(const Offset& now) const;

    /// The determinant: what a volume of phase space has grown or shrunk to; decay^3 of a conformal map.
    double volume() const;
};

MapBlocks blocks_of(const FlowMap& map, double decay);

/// How to obtain the map of a cluster of a given age.
struct MapRule {
    MapKind kind = MapKind::Identity;
    double drag = 0; ///< k, 1 / time
    double step = 0; ///< time of one frame
    /// Whether full maps are; not where an acceleration has a curl, or drag or wind depends on the place.
    bool conformal = true;

    /// exp(-k age), which every conformal map of this age shrinks phase space by.
    double decay(std::uint64_t age_frames) const;

    /// The map of a cluster formed `age_frames` ago; `full` is read only for MapKind::Full.
    MapBlocks blocks(std::uint64_t age_frames, const FlowMap* full) const;
};

/// (1 - exp(-k t)) / k, or t without drag: how far unit velocity carries in time t.
double drag_drift(double drag, double time);

/// drag_drift by the age of a scalar map, looked up for clusters of up to a thousand frames.
class DriftByAge {
public:
    explicit DriftByAge(const MapRule& rule);

    double operator()(std::uint64_t age_frames) const
    {
        return age_frames < drifts_.size() ? drifts_[age_frames]
                                           : drag_drift(drag_, double(age_frames) * step_);
    }

private:
    double drag_, step_;
    std::vector<double> drifts_;
};

} // namespace slod
