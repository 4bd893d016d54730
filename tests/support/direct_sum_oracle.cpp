#include "support/direct_sum_oracle.hpp"

#include <cmath>

namespace slod::test {

Vector3d acceleration_at(const Vector3d& x, double q, std::span<const PointMass> bodies, double G,
                         const PointMass* except)
{
    Vector3d sum{0, 0, 0};
    for (const PointMass& body : bodies) {
        const Vector3d d = body.position - x;
        const double square = d.squaredNorm() + q + body.q;
        if (&body != except && square > 0)
            sum += G * body.mass / (square * std::sqrt(square)) * d;
    }
    return sum;
}

double potential_energy_of(std::span<const PointMass> bodies, double G)
{
    double sum = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double square =
                (bodies[i].position - bodies[j].position).squaredNorm() + bodies[i].q + bodies[j].q;
            sum -= square > 0 ? G * bodies[i].mass * bodies[j].mass / std::sqrt(square) : 0;
        }
    }
    return sum;
}

} // namespace slod::test
