#include "cost/plain_loops.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "core/parallel.hpp"
#include "effects/uniform_fields.hpp"

namespace slod::cost {
namespace {

constexpr std::size_t stars_of_task = 64;
constexpr std::size_t pools_of_emitter = 16;

} // namespace

PlainStars::PlainStars(const SimulationSettings& scene, const ParticleSet& stars)
    : step_(scene.time.step),
      constant_(scene.units.gravitational_constant() * (scene.gravity ? scene.gravity->strength : 0))
{
    for (const Particle& star : stars) {
        const double softening = scene.kinds[star.kind].softening;
        stars_.push_back({star.position, star.velocity, {0, 0, 0}, star.mass, softening * softening});
    }
    accelerate();
}

void PlainStars::accelerate()
{
    for_each_block(stars_.size(), stars_of_task, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Star& star = stars_[i];
            Vector3d sum(0, 0, 0);
            for (std::size_t j = 0; j < stars_.size(); ++j) {
                const Star& other = stars_[j];
                if (j == i)
                    continue;
                const Vector3d apart = other.position - star.position;
                const double square =
                    apart.squaredNorm() + 0.5 * (star.softening_squared + other.softening_squared);
                sum += other.mass / (square * std::sqrt(square)) * apart;
            }
            star.acceleration = constant_ * sum;
        }
    });
}

void PlainStars::kick()
{
    for (Star& star : stars_)
        star.velocity += 0.5 * step_ * star.acceleration;
}

void PlainStars::step()
{
    kick();
    for (Star& star : stars_)
        star.position += step_ * star.velocity;
    accelerate();
    kick();
}

PlainDroplets::PlainDroplets(const SimulationSettings& scene)
    : step_(scene.time.step), drag_(0), gravity_(0, 0, 0), wind_(0, 0, 0), emitters_(scene.emitters)
{
    const UniformFields fields(scene.uniform_gravity, scene.linear_drag, scene.uniform_wind);
    drag_ = fields.drag;
    gravity_ = fields.gravity;
    wind_ = fields.wind;
    for (const EmitterSettings& emitter : emitters_)
        for (std::size_t pool = 0; pool < pools_of_emitter; ++pool) {
            pools_.push_back({.emitter = &emitter});
            pools_.back().random.seed(std::uint32_t(pools_.size()));
        }
}

void PlainDroplets::step()
{
    for_each_task(pools_.size(), [&](std::size_t pool) {
        move(pools_[pool]);
        bear(pools_[pool]);
    });
}

void PlainDroplets::advance(Droplet& droplet, double time) const
{
    droplet.velocity += time * (gravity_ + drag_ * (wind_ - droplet.velocity));
    droplet.position += time * droplet.velocity;
    droplet.age += time;
}

void PlainDroplets::move(Pool& pool) const
{
    std::vector<Droplet>& droplets = pool.droplets;
    for (std::size_t i = 0; i < droplets.size();) {
        advance(droplets[i], step_);
        if (droplets[i].age < pool.emitter->lifetime) {
            ++i;
        } else {
            droplets[i] = droplets.back();
            droplets.pop_back();
        }
    }
}

void PlainDroplets::bear(Pool& pool) const
{
    const EmitterSettings& emitter = *pool.emitter;
    const Vector3d forward = emitter.direction.normalized();
    const Vector3d side = forward.unitOrthogonal(), other_side = forward.cross(side);
    const double cone_cosine = std::cos(emitter.cone_angle_deg * std::numbers::pi / 180);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (pool.owed += emitter.rate * step_ / double(pools_of_emitter); pool.owed >= 1; --pool.owed) {
        const double cosine = 1 - uniform(pool.random) * (1 - cone_cosine);
        const double sine = std::sqrt(1 - cosine * cosine);
        const double azimuth = 2 * std::numbers::pi * uniform(pool.random);
        const double speed = emitter.speed * (1 + emitter.speed_spread * (2 * uniform(pool.random) - 1));
        const Vector3d direction =
            cosine * forward + sine * (std::cos(azimuth) * side + std::sin(azimuth) * other_side);
        Droplet droplet{emitter.position, speed * direction, 0};
        advance(droplet, step_ * uniform(pool.random));
        pool.droplets.push_back(droplet);
    }
}

std::size_t PlainDroplets::size() const
{
    return std::accumulate(pools_.begin(), pools_.end(), std::size_t(0),
                           [](std::size_t sum, const Pool& pool) { return sum + pool.droplets.size(); });
}

std::vector<Vector3d> PlainDroplets::positions() const
{
    std::vector<Vector3d> all;
    for (const Pool& pool : pools_)
        for (const Droplet& droplet : pool.droplets)
            all.push_back(droplet.position);
    return all;
}

} // namespace slod::cost
