#include "cluster/flow_map.hpp"

#include <Eigen/LU>

#include "core/assert.hpp"
#include "core/portable_math.hpp"

namespace slod {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Matrix6d whole(const MapBlocks& map)
{
    Matrix6d matrix;
    matrix << map.a, map.b, map.c, map.d;
    return matrix;
}

} // namespace

bool is_worn(const FlowMap& map)
{
    constexpr float most = 8;
    return map.a_minus_1.cwiseAbs().maxCoeff() > most || map.d_minus_1.cwiseAbs().maxCoeff() > most;
}

void kick(FlowMap& map, double step, const Matrix3d& tide)
{
    const Matrix3f pull = (step * tide).cast<float>();
    map.c += pull + pull * map.a_minus_1;
    map.d_minus_1 += pull * map.b;
}

void propagate(FlowMap& map, const Propagator& step)
{
    const float drift = float(step.drift);
    const float loss = float(step.decay_minus_1);
    map.a_minus_1 += drift * map.c;
    map.b += drift * (map.d_minus_1 + Matrix3f::Identity());
    if (loss == 0)
        return;
    map.c += loss * map.c;
    map.d_minus_1 += loss * (map.d_minus_1 + Matrix3f::Identity());
}

void propagate(FlowMap& map, const Tangent& step)
{
    const Matrix3f c = map.c, b = map.b;
    const Matrix3f a = map.a_minus_1, d = map.d_minus_1;
    map.a_minus_1 += step.xx + step.xx * a + step.xv * c;
    map.b += step.xv + step.xx * b + step.xv * d;
    map.c += step.vx + step.vx * a + step.vv * c;
    map.d_minus_1 += step.vv + step.vx * b + step.vv * d;
}

MapBlocks::Offset MapBlocks::inverse(const Offset& now) const
{
    if (!conformal) {
        Vector6d target;
        target << now.position, now.velocity;
        const Vector6d solved = whole(*this).partialPivLu().solve(target);
        return {solved.head<3>(), solved.tail<3>()};
    }
    const auto approximate = [&](const Offset& target) -> Offset {
        return {(d.transpose() * target.position - b.transpose() * target.velocity) / decay,
                (a.transpose() * target.velocity - c.transpose() * target.position) / decay};
    };
    Offset formed = approximate(now);
    const Offset reached = forward(formed);
    const Offset correction = approximate({now.position - reached.position, now.velocity - reached.velocity});
    formed.position += correction.position;
    formed.velocity += correction.velocity;
    return formed;
}

double MapBlocks::volume() const
{
    return whole(*this).partialPivLu().determinant();
}

MapBlocks blocks_of(const FlowMap& map, double decay)
{
    MapBlocks blocks;
    blocks.a += map.a_minus_1.cast<double>();
    blocks.b = map.b.cast<double>();
    blocks.c = map.c.cast<double>();
    blocks.d += map.d_minus_1.cast<double>();
    blocks.decay = decay;
    return blocks;
}

double drag_drift(double drag, double time)
{
    return drag == 0 ? time : -portable_expm1(-drag * time) / drag;
}

double MapRule::decay(std::uint64_t age_frames) const
{
    return kind == MapKind::Identity || drag == 0 ? 1.0 : portable_exp(-drag * (double(age_frames) * step));
}

MapBlocks MapRule::blocks(std::uint64_t age_frames, const FlowMap* full) const
{
    if (kind == MapKind::Identity)
        return {};
    if (kind == MapKind::Full) {
        SLOD_ASSERT(full != nullptr);
        MapBlocks blocks = blocks_of(*full, conformal ? decay(age_frames) : 1.0);
        blocks.conformal = conformal;
        return blocks;
    }
    MapBlocks blocks;
    blocks.b = drag_drift(drag, double(age_frames) * step) * Matrix3d::Identity();
    blocks.decay = decay(age_frames);
    blocks.d = blocks.decay * Matrix3d::Identity();
    return blocks;
}

DriftByAge::DriftByAge(const MapRule& rule) : drag_(rule.drag), step_(rule.step)
{
    constexpr std::uint64_t ages = 1024;
    for (std::uint64_t age = 0; rule.kind == MapKind::Scalar && age < ages; ++age)
        drifts_.push_back(drag_drift(drag_, double(age) * step_));
}

} // namespace slod
