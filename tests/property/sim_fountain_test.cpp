#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "cluster/moments.hpp"
#include "effects/emitter.hpp"
#include "scene/scene.hpp"
#include "sim/simulation.hpp"
#include "support/newborns.hpp"

// The fountain scene at 64 droplets per cluster against every droplet's own closed-form path, from its birth
// until its death: one stream, then two, then three, and two and a half seconds of all three in full.
namespace slod::test {
namespace {

constexpr std::uint64_t frame_count = 15 * 60; ///< the third stream starts at 10 s and is full at 12.5 s
constexpr std::uint64_t steady = 13 * 60;

SimulationSettings fountain(const std::vector<std::string>& overrides)
{
    const auto loaded = load_scene(SLOD_SCENES "/fountain.toml", overrides);
    if (const auto* problems = std::get_if<Problems>(&loaded))
        throw std::runtime_error(problems->front());
    return std::get<Scene>(loaded).simulation;
}

/// How a droplet starts, and when it is gone.
struct Birth {
    double time = 0;
    Vector3d position, velocity;
    std::uint32_t expiry_frame = 0;
};

/// The droplets that should be in the air, by id. An emitter in no field at all hands out particles that
/// have only moved straight on since their birth.
class Births {
public:
    explicit Births(const SimulationSettings& settings) : step_(settings.time.step)
    {
        for (std::size_t i = 0; i < settings.emitters.size(); ++i)
            emitters_.emplace_back(settings.emitters[i], std::uint32_t(i), std::uint8_t{0}, settings.seed);
    }

    /// Adds the births of a frame and forgets those whose last frame it was.
    void follow(std::uint64_t frame)
    {
        std::vector<Newborn> newborns;
        for (const Emitter& emitter : emitters_)
            test::add_newborns(emitter, frame, step_, UniformFields{}, newborns);
        for (const Newborn& born : newborns) {
            const Particle& particle = born.particle;
            living_[particle.id] = {double(frame) * step_ - born.age,
                                    particle.position - born.age * particle.velocity, particle.velocity,
                                    particle.expiry_frame};
        }
        std::erase_if(living_, [&](const auto& entry) { return entry.second.expiry_frame <= frame; });
    }

    const std::map<std::uint64_t, Birth>& living() const { return living_; }

private:
    double step_;
    std::vector<Emitter> emitters_;
    std::map<std::uint64_t, Birth> living_;
};

/// A droplet's path, dv/dt = g - k (v - u), by the textbook and the C library.
class Path {
public:
    explicit Path(const SimulationSettings& settings)
        : drag_(settings.linear_drag->rate),
          terminal_(settings.uniform_wind->velocity + settings.uniform_gravity->acceleration / drag_)
    {}

    Vector3d position(const Birth& birth, double age) const
    {
        const double carried = -std::expm1(-drag_ * age) / drag_;
        return birth.position + carried * (birth.velocity - terminal_) + age * terminal_;
    }

    Vector3d velocity(const Birth& birth, double age) const
    {
        return terminal_ + std::exp(-drag_ * age) * (birth.velocity - terminal_);
    }

private:
    double drag_;
    Vector3d terminal_;
};

double broadest(const ClusterStates& clusters)
{
    double most = 0;
    for (const auto& c : clusters.covariance)
        most = std::max(most, breadth({c[0], c[1], c[2], c[3], c[4], c[5]}, 1));
    return most;
}

/// The largest differences between droplets and their paths over a run.
struct Differences {
    double position = 0; ///< in units of the distance from the birthplace or the broadest cluster's breadth
    double velocity = 0; ///< in units of the speed at birth

    void note(const Particle& particle, const Birth& birth, const Path& path, double age, double breadth)
    {
        const Vector3d there = path.position(birth, age);
        const double scale = std::max((there - birth.position).norm(), breadth);
        position = std::max(position, (particle.position - there).norm() / scale);
        velocity = std::max(velocity,
                            (particle.velocity - path.velocity(birth, age)).norm() / birth.velocity.norm());
    }
};

std::vector<std::uint64_t> ids_of(const ParticleSet& particles)
{
    std::vector<std::uint64_t> ids;
    for (const Particle& particle : particles)
        ids.push_back(particle.id);
    return ids;
}

std::vector<std::uint64_t> ids_of(const std::map<std::uint64_t, Birth>& births)
{
    std::vector<std::uint64_t> ids;
    for (const auto& [id, birth] : births)
        ids.push_back(id);
    return ids;
}

/// Follows every droplet over the whole run. Stops when those in the air are not those that should be.
Differences differences_in(const SimulationSettings& settings)
{
    Differences differences;
    Simulation simulation(settings, {}, {});
    Births births(settings);
    const Path path(settings);
    for (std::uint64_t frame = 1; frame <= frame_count && !testing::Test::HasFailure(); ++frame) {
        const double breadth = broadest(simulation.step({.clusters = true}).clusters);
        births.follow(frame);
        const ParticleSet particles = simulation.particles();
        EXPECT_EQ(ids_of(particles), ids_of(births.living())) << "frame " << frame;
        auto birth = births.living().begin();
        for (const Particle& particle : particles) {
            const double age = double(frame) * settings.time.step - birth->second.time;
            differences.note(particle, birth->second, path, age, breadth);
            if (++birth == births.living().end())
                break;
        }
    }
    return differences;
}

class ExactFountain : public testing::TestWithParam<const char*> {};

// A cluster's members are kept in float relative to its centre: offset and relative velocity are rounded by
// 2^-24 each when a droplet joins, that is by 1.2e-7 of what they amount to together, which is of the order
// of the breadth. A droplet is in a handful of clusters in its life, as they split; 1e-6 leaves room for
// eight.
TEST_P(ExactFountain, KeepsEveryDropletOnItsPath)
{
    const Differences differences = differences_in(fountain({GetParam()}));
    EXPECT_LE(differences.position, 1e-6);
    EXPECT_LE(differences.velocity, 1e-6);
}

// The default, every droplet by itself, clusters that are never broad enough to split, and the map of freely
// streaming members, which is the same one here.
INSTANTIATE_TEST_SUITE_P(Scenes, ExactFountain,
                         testing::Values("background.max_cluster_size=64", "background.max_cluster_size=1",
                                         "background.max_breadth=100.0", "motion.kind=\"stream\""));

TEST(RigidFountain, TakesDropletsFarFromTheirPaths)
{
    EXPECT_GT(differences_in(fountain({"motion.kind=\"rigid\""})).position, 0.1);
}

// In the air are those that started within one lifetime: rate times lifetime, or one less.
TEST(Fountain, KeepsTwoThousandDropletsPerStreamInTheAir)
{
    Simulation simulation(fountain({}), {}, {});
    for (std::uint64_t frame = 1; frame <= frame_count; ++frame) {
        simulation.step({});
        if (frame < steady || frame % 10 != 0)
            continue;
        std::map<std::uint64_t, int> streams;
        for (const Particle& particle : simulation.particles())
            ++streams[particle.id >> Emitter::id_shift];
        EXPECT_EQ(streams.size(), 3U);
        for (const auto& [stream, count] : streams)
            EXPECT_NEAR(count, 1999.5, 0.5) << "stream " << stream << " in frame " << frame;
    }
}

// Without a limit to its breadth a cluster is filled and stays so until its droplets die: of 2,000 droplets
// in clusters of 64, at most one is being filled and one is dying out.
TEST(UnlimitedFountain, FillsItsClusters)
{
    Simulation simulation(fountain({"background.max_breadth=100.0"}), {}, {});
    for (std::uint64_t frame = 1; frame < steady; ++frame)
        simulation.step({});
    const FrameCounts& counts = simulation.step({}).counts;
    EXPECT_LE(counts.clusters, 3 * (2000 / 64 + 2U));
}

} // namespace
} // namespace slod::test
