#include "support/pair_error.hpp"

#include <algorithm>
#include <cmath>

namespace slod::test {
namespace {

double norm(const Vector3d& position, const Vector3d& velocity)
{
    return std::sqrt(position.squaredNorm() + velocity.squaredNorm());
}

} // namespace

PairError compare_pairs(const ParticleSet& mapped, const ParticleSet& free)
{
    const Vector3d x0 = mapped[0].position - free[0].position, x1 = mapped[1].position - free[1].position;
    const Vector3d v0 = mapped[0].velocity - free[0].velocity, v1 = mapped[1].velocity - free[1].velocity;
    const Vector3d offset = 0.5 * (free[0].position - free[1].position);
    const Vector3d relative_velocity = 0.5 * (free[0].velocity - free[1].velocity);
    PairError error{norm(0.5 * (x0 + x1), 0.5 * (v0 + v1)), norm(0.5 * (x0 - x1), 0.5 * (v0 - v1)),
                    norm(offset, relative_velocity), offset.norm(), INFINITY};
    for (std::size_t member = 0; member < 2; ++member)
        for (std::size_t body = 2; body < free.size(); ++body)
            error.nearest = std::min(error.nearest, (free[member].position - free[body].position).norm());
    return error;
}

} // namespace slod::test
