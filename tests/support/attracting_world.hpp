#pragma once

#include <cstdint>
#include <vector>

#include "gravity/forces.hpp"
#include "support/direct_sum_oracle.hpp"
#include "support/little_worlds.hpp"

namespace slod::test {

/// Single particles in one region or several, as the force view shows them, and their accelerations with G =
/// 1 by the code under test and by the oracle.
class AttractingWorld {
public:
    /// All in one region, whose cells span the particles and are divided as the simulation divides them.
    explicit AttractingWorld(const ParticleSet& particles, double softening = 0.05);

    /// One region after another, each with its particles.
    explicit AttractingWorld(const std::vector<ParticleSet>& regions, double softening = 0.05);

    /// Rebuilds the view, as every frame does; done by the constructor, too.
    void rebuild();

    /// Evaluates with the settings as they are.
    ForceCounts evaluate(const simd::KernelTable& kernels = simd::kernels());

    /// The same after the pulls that the relative criterion compares with have been made those of another
    /// evaluation, as in all frames but the first.
    ForceCounts evaluate_again();

    ClusterTable& clusters() { return world_.store.clusters; }
    const Vector3d& acceleration(std::size_t body) const
    {
        return world_.store.clusters.acceleration[view.slot[body].index];
    }
    Matrix3d tide(std::size_t body) const
    {
        return world_.store.clusters.tide[view.slot[body].index].matrix();
    }
    Vector3d exact(std::size_t body) const; ///< by the oracle, of all regions' pulls

    /// Accelerations by id of the particle, from 1 on.
    std::vector<Vector3d> by_id() const;

    GravitySettings settings;
    ForceView view;
    ForceLists lists;              ///< of the last evaluation
    std::vector<PointMass> bodies; ///< of the view

private:
    World world_;
};

/// Single particles whose forces come from walks of the tree, however few they are.
AttractingWorld walked(const ParticleSet& particles, double softening = 0.01);

/// Quantiles of |a - exact| / |exact|.
struct ForceErrors {
    double median = 0, p99 = 0, largest = 0, rms = 0;
};

/// Of `count` bodies spread evenly over the view's order.
ForceErrors force_errors(const AttractingWorld& world, std::size_t count = 1000);

} // namespace slod::test
