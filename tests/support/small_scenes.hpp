#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "cluster/particles.hpp"
#include "sim/settings.hpp"

namespace slod::test {

/// A spherical cloud of particles of one mass, near equilibrium under G = 1.
struct Cloud {
    std::uint32_t count = 1;
    double mass = 1;  ///< of the whole cloud
    double scale = 1; ///< Plummer's scale length
    Vector3d centre{0, 0, 0};
    Vector3d velocity{0, 0, 0};
    std::uint8_t kind = 0;
};

/// Appends the cloud's particles; ids go on from the number of particles that are there.
void add_cloud(ParticleSet& particles, const Cloud& cloud, std::uint64_t seed);

/// Settings with G = 1, one kind "star" of softening 0.05, a step of 1/64 and nothing else.
SimulationSettings quiet_settings();

/// An emitter of kind "star" at the origin, straight up at speed 4, 640 particles per time that live for
/// half a unit of time: ten a frame of quiet_settings(), 320 in the air.
EmitterSettings jet(const std::string& name);

/// A scene small enough to run in many ways.
struct SmallScene {
    std::string name;
    SimulationSettings settings;
    ParticleSet initial;
};

/// For messages of tests: its name.
void PrintTo(const SmallScene& scene, std::ostream* out);

/// One scene for every road through the step: motion flow, stream and rigid in self-gravity, unclustered,
/// in double, by walks of the tree, a fountain, one with regions of interest, one of two kinds falling
/// onto attracting clouds, three among colliders and one among meshes, two in accelerations of place, three
/// in winds, one that is kicked, two with sinks, and one
/// whose frames are cut into steps, and which a particle leaves.
std::vector<SmallScene> small_scenes();

/// The one of that name.
SmallScene small_scene(const std::string& name);

/// The state's hash after so many frames, in which nothing may go wrong.
std::uint64_t hash_of(const SmallScene& scene, int threads = 2, int frames = 40);

} // namespace slod::test
