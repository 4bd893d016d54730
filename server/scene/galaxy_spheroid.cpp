#include "scene/galaxy_spheroid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace slod {

namespace {

constexpr std::size_t radius_steps = 400;

/// The spheroid at one radius.
struct Level {
    double depth;   ///< potential at the cut-off minus that here
    double density; ///< up to a constant factor
};

/// Particles per volume of phase space with energies between one level's depth and the next one's, up to a
/// constant factor. Abel's equation by product integration: density is linear in depth between levels.
std::vector<double> distribution_function(const std::vector<Level>& levels)
{
    std::vector<double> integral(levels.size());
    for (std::size_t i = 1; i < levels.size(); ++i) {
        double root = std::sqrt(levels[i].depth);
        for (std::size_t k = 1; k <= i; ++k) {
            const double next_root = std::sqrt(levels[i].depth - levels[k].depth);
            const double rise = levels[k].density - levels[k - 1].density;
            integral[i] += rise / (levels[k].depth - levels[k - 1].depth) * 2 * (root - next_root);
            root = next_root;
        }
    }
    std::vector<double> particles(levels.size() - 1);
    for (std::size_t k = 0; k < particles.size(); ++k)
        particles[k] =
            std::max(0.0, (integral[k + 1] - integral[k]) / (levels[k + 1].depth - levels[k].depth));
    return particles;
}

NormalQuantiles speed_quantiles(const std::vector<Level>& levels, const std::vector<double>& particles,
                                std::size_t here)
{
    std::vector<double> speed{0}, below{0};
    for (std::size_t k = here; k-- > 0;) {
        const double v = std::sqrt(2 * (levels[here].depth - levels[k].depth));
        const double shell = v * v * v - speed.back() * speed.back() * speed.back();
        below.push_back(below.back() + particles[k] * shell);
        speed.push_back(v);
    }
    return normal_quantiles(speed, below);
}

} // namespace

IsotropicSpeeds::IsotropicSpeeds(const SpheroidShape& spheroid,
                                 const std::function<double(double)>& potential)
    : scale_length_(spheroid.scale_length),
      steps_per_s_(radius_steps * (spheroid.cutoff + spheroid.scale_length) / spheroid.cutoff)
{
    const double edge = potential(spheroid.cutoff);
    std::vector<Level> levels{{0, 0}};
    for (std::size_t i = 1; i < radius_steps; ++i) {
        const double s = double(radius_steps - i) / steps_per_s_;
        const double radius = scale_length_ * s / (1 - s);
        levels.push_back({edge - potential(radius), spheroid.relative_density(radius)});
    }
    const std::vector<double> particles = distribution_function(levels);
    quantiles_.emplace_back(); // nothing moves at the cut-off
    for (std::size_t i = 1; i < levels.size(); ++i)
        quantiles_.push_back(speed_quantiles(levels, particles, i));
}

double IsotropicSpeeds::speed(double radius, double deviate) const
{
    const double outwards = radius / (radius + scale_length_) * steps_per_s_;
    const double inwards = std::clamp(radius_steps - outwards, 0.0, double(quantiles_.size() - 1));
    const std::size_t i = std::min(std::size_t(inwards), quantiles_.size() - 2);
    const double outer = value_at(quantiles_[i], deviate), inner = value_at(quantiles_[i + 1], deviate);
    return outer + (inwards - double(i)) * (inner - outer);
}

} // namespace slod
