#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "cluster/particles.hpp"
#include "core/vectors.hpp"
#include "sim/settings.hpp"

/// The two simulations of O'Brien et al. 2001, section 6.1, as one would write them who has neither clusters
/// nor time for more than arrays of structs and double precision: compiled at -O2, on the threads of the
/// caller's team.
namespace slod::cost {

/// Stars that attract each other: the sum over all pairs, and leapfrog.
class PlainStars {
public:
    /// Gravity, softening lengths and step of `scene`, and nothing else of it.
    PlainStars(const SimulationSettings& scene, const ParticleSet& stars);

    void step(); ///< O(N^2)

    std::size_t size() const { return stars_.size(); }
    const Vector3d& position(std::size_t star) const { return stars_[star].position; }
    const Vector3d& velocity(std::size_t star) const { return stars_[star].velocity; }

private:
    struct Star {
        Vector3d position, velocity, acceleration;
        double mass;
        double softening_squared;
    };

    void accelerate();
    void kick();

    double step_, constant_;
    std::vector<Star> stars_;
};

/// Droplets that are born by random numbers, fall, drift and die of age: Euler's steps. They are in pools, so
/// that threads need not wait for each other.
class PlainDroplets {
public:
    /// Emitters, all from the start on, gravity, linear drag and wind of `scene`, and nothing else of it.
    explicit PlainDroplets(const SimulationSettings& scene);

    void step();

    std::size_t size() const;
    std::vector<Vector3d> positions() const; ///< in no order

private:
    struct Droplet {
        Vector3d position, velocity;
        double age;
    };
    struct Pool {
        const EmitterSettings* emitter;
        std::vector<Droplet> droplets{};
        std::mt19937 random{};
        double owed = 0; ///< births, in [0, 1) between steps
    };

    void move(Pool& pool) const;
    void bear(Pool& pool) const;
    void advance(Droplet& droplet, double time) const;

    double step_, drag_;
    Vector3d gravity_, wind_;
    std::vector<EmitterSettings> emitters_;
    std::vector<Pool> pools_;
};

} // namespace slod::cost
