#include "cost/force_errors.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "cost/quantile.hpp"

namespace slod::cost {
namespace {

Vector3d exact_force(const ParticleSet& bodies, std::size_t target, double softening)
{
    const Vector3d& x = bodies[target].position;
    Vector3d sum{0, 0, 0};
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        const Vector3d d = bodies[body].position - x;
        const double square = d.squaredNorm() + softening * softening;
        if (body != target && square > 0)
            sum += double(bodies[body].mass) / (square * std::sqrt(square)) * d;
    }
    return sum;
}

} // namespace

ExactForces exact_forces(const ParticleSet& bodies, double softening, std::size_t samples)
{
    const std::size_t count = std::min(samples, bodies.size());
    ExactForces exact{std::vector<std::size_t>(count), std::vector<Vector3d>(count)};
    for_each_task(count, [&](std::size_t sample) {
        const std::size_t body = sample * bodies.size() / count;
        exact.bodies[sample] = body;
        exact.accelerations[sample] = exact_force(bodies, body, softening);
    });
    return exact;
}

ForceErrors force_errors(std::span<const Vector3d> accelerations, const ExactForces& exact)
{
    std::vector<double> errors;
    double squares = 0;
    for (std::size_t sample = 0; sample < exact.bodies.size(); ++sample) {
        const Vector3d& truth = exact.accelerations[sample];
        if (truth.isZero(0))
            continue;
        errors.push_back((accelerations[exact.bodies[sample]] - truth).norm() / truth.norm());
        squares += errors.back() * errors.back();
    }
    if (errors.empty())
        return {};
    return {.median = quantile(errors, 0.5),
            .p90 = quantile(errors, 0.9),
            .p99 = quantile(errors, 0.99),
            .max = quantile(errors, 1),
            .rms = std::sqrt(squares / double(errors.size()))};
}

} // namespace slod::cost
