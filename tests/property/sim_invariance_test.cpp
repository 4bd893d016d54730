#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/leapfrog.hpp"
#include "support/small_scenes.hpp"

// A galaxy does not know where it is nor how fast it flies, whether somebody is far away, nor whether tracers
// without mass are about.
namespace slod::test {
namespace {

constexpr int frame_count = 100;
const Vector3d middle(20'000, 20'000, 20'000); ///< well inside a cell of side 65,536

struct Frame {
    Vector3d shift{0, 0, 0}, boost{0, 0, 0};
};

/// How the galaxy is clustered.
struct Clustering {
    const char* name;
    double max_cluster_size, pool_factor, max_breadth;

    friend std::ostream& operator<<(std::ostream& out, const Clustering& c) { return out << c.name; }
};

constexpr Clustering unclustered{"unclustered", 1, 4, 65'536};
constexpr Clustering one_pool{"one_pool", 32, 64, 65'536}; ///< holds 2,048 particles
constexpr Clustering many_cells{"many_cells", 16, 4, 0.5};
constexpr Clustering boundless{"boundless", 16, 4, INFINITY};

SimulationSettings settings_of(const Clustering& clustering)
{
    SimulationSettings settings = quiet_settings();
    settings.gravity.emplace();
    settings.background.max_cluster_size = clustering.max_cluster_size;
    settings.background.pool_factor = clustering.pool_factor;
    settings.background.max_breadth = clustering.max_breadth;
    return settings;
}

ParticleSet galaxy(const Frame& frame)
{
    ParticleSet particles;
    add_cloud(particles, {.count = 1500, .centre = middle}, 5);
    for (Particle& particle : particles) {
        particle.position += frame.shift;
        particle.velocity += frame.boost;
    }
    return particles;
}

ParticleSet run(const SimulationSettings& settings, const ParticleSet& initial)
{
    Simulation simulation(settings, initial, {});
    for (int frame = 0; frame < frame_count; ++frame)
        simulation.step({});
    EXPECT_EQ(simulation.problems(), Problems{});
    return simulation.particles();
}

/// The particles after the run, as seen from the frame.
ParticleSet run_in(const Frame& frame, const SimulationSettings& settings)
{
    ParticleSet particles = run(settings, galaxy(frame));
    const double time = frame_count * settings.time.step;
    for (Particle& particle : particles) {
        particle.position -= frame.shift + time * frame.boost;
        particle.velocity -= frame.boost;
    }
    return particles;
}

// Two runs differ by what is rounded: a pull by a few units of 2^-24, here of 0.4 at most, which acts for
// half of 1.56^2 and moves a particle by 3e-8; and the tide of a neighbour within its softening, 7e-4 /
// 0.05^3 = 5, amplifies that by less than exp(1.56 sqrt(5)) = 33. Positions at 2e7 are rounded by 2e-9 a
// hundred times.
constexpr double rounding = 1e-6;

class MovingFrame : public testing::TestWithParam<Clustering> {};

std::string name_of(const testing::TestParamInfo<Clustering>& info)
{
    return info.param.name;
}

// The shift is a multiple of the smallest cells' side, and keeps the galaxy inside one of the large ones.
TEST_P(MovingFrame, G27_FarFromTheOriginTheGalaxyEvolvesAlike)
{
    const SimulationSettings settings = settings_of(GetParam());
    const ParticleSet near = run_in({}, settings);
    EXPECT_GT(largest_distance(near, galaxy({})), 1);
    for (const Vector3d& shift : {Vector3d(1e7, 0, 0), Vector3d(1e7, -1e7, 2e7)})
        expect_at_most("largest distance from the run near the origin",
                       largest_distance(run_in({.shift = shift}, settings), near), rounding);
}

INSTANTIATE_TEST_SUITE_P(Clusterings, MovingFrame, testing::Values(unclustered, one_pool, many_cells),
                         name_of);

class FlyingFrame : public testing::TestWithParam<Clustering> {};

// The cells stand still, so that only a galaxy within one of them is divided alike.
TEST_P(FlyingFrame, G28_TheGalaxyEvolvesAsAtRest)
{
    const SimulationSettings settings = settings_of(GetParam());
    const ParticleSet at_rest = run_in({}, settings);
    for (const Vector3d& boost : {Vector3d(1e3, 0, 0), Vector3d(-1e3, 1e3, 1e3)})
        expect_at_most("largest distance from the run at rest",
                       largest_distance(run_in({.boost = boost}, settings), at_rest), rounding);
}

INSTANTIATE_TEST_SUITE_P(Clusterings, FlyingFrame, testing::Values(unclustered, one_pool), name_of);

/// A galaxy and one particle this far away from it.
ParticleSet galaxy_and_outcast(double distance)
{
    ParticleSet particles = galaxy({});
    particles.push_back({distance * Vector3d(1, -1, 1), {0, 1, 0}, particles.size(), 1e-3F});
    return particles;
}

class Outcast : public testing::TestWithParam<double> {};

TEST_P(Outcast, G35_ChangesNothingAboutTheGalaxy)
{
    const SimulationSettings settings = settings_of(unclustered);
    ParticleSet particles = run(settings, galaxy_and_outcast(GetParam()));
    particles.pop_back();
    expect_at_most("largest distance from the run without it",
                   largest_distance(particles, run(settings, galaxy({}))), rounding);
}

// With cells of no given side the outcast decides how large they are.
TEST_P(Outcast, G35_LeavesClustersSound)
{
    for (const Clustering& clustering : {one_pool, many_cells, boundless}) {
        const SimulationSettings settings = settings_of(clustering);
        const ParticleSet initial = galaxy_and_outcast(GetParam());
        const ParticleSet particles = run(settings, initial);
        ASSERT_EQ(particles.size(), initial.size());
        for (const Particle& particle : particles)
            EXPECT_TRUE(particle.position.allFinite() && particle.velocity.allFinite()) << particle.id;
        const Vector3d there =
            initial.back().position + frame_count * settings.time.step * initial.back().velocity;
        expect_at_most("the outcast's distance from its straight line, of that of the galaxy",
                       (particles.back().position - there).norm() / GetParam(), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Distances, Outcast, testing::Values(1e5, 1e9, 1e15));

/// Adds massless particles about the centre.
ParticleSet with_tracers(ParticleSet particles, const Vector3d& centre)
{
    const std::size_t heavy = particles.size();
    add_cloud(particles, {.count = 1000, .scale = 3, .centre = centre}, 6);
    for (std::size_t i = heavy; i < particles.size(); ++i)
        particles[i].mass = 0;
    return particles;
}

class Tracers : public testing::TestWithParam<Precision> {
protected:
    static SimulationSettings settings()
    {
        SimulationSettings settings = settings_of(unclustered);
        settings.gravity->precision = GetParam();
        return settings;
    }
};

// They change the order in which the tree lists the bodies, and with it the rounding of sums. In double that
// is 2^-29 of the above, and less than the rounding of positions below 8, amplified.
TEST_P(Tracers, G23_DoNotAct)
{
    const Frame at_origin{.shift = -middle};
    const ParticleSet alone = run(settings(), galaxy(at_origin));
    ParticleSet particles = run(settings(), with_tracers(galaxy(at_origin), Vector3d::Zero()));
    particles.resize(alone.size());
    const double tolerance = GetParam() == Precision::Mixed ? rounding : 33 * frame_count * 8 * 0x1p-53;
    expect_at_most("largest distance of a heavy one from the run without tracers",
                   largest_distance(particles, alone), tolerance);
}

TEST_P(Tracers, G23_DoNotMoveALoneBodyByOneBit)
{
    const ParticleSet body{{middle, {0, 0, 0}, 0, 1}};
    const ParticleSet particles = run(settings(), with_tracers(body, middle));
    expect_at_most("distance that the body was moved", (particles.front().position - middle).norm(), 0);
    expect_at_most("speed that the body was given", particles.front().velocity.norm(), 0);
}

// Tracers feel each heavy body and nothing else: they move like test bodies of a leapfrog.
TEST_P(Tracers, G23_FeelWhatIsHeavy)
{
    ParticleSet initial{{{2, 0, 0}, {0, 0.25, 0}, 0, 1}, {{-2, 0, 0}, {0, -0.25, 0}, 1, 1}};
    initial = with_tracers(initial, Vector3d::Zero());
    SimulationSettings settings = Tracers::settings();
    settings.kinds.front().softening = 0.5; // tides up to 1 / 0.5^3 amplify by exp(1.56 sqrt(8)) = 83
    const ParticleSet free = leapfrog(initial, settings, frame_count);
    const double unit = GetParam() == Precision::Mixed ? 0x1p-24 : frame_count * 0x1p-53;
    expect_at_most("largest distance from a leapfrog of test bodies",
                   largest_distance(run(settings, initial), free), 83 * 16 * unit); // of distances up to 16
}

std::string precision_of(const testing::TestParamInfo<Precision>& info)
{
    return std::string(names(info.param)[std::size_t(info.param)]);
}

INSTANTIATE_TEST_SUITE_P(Precisions, Tracers, testing::Values(Precision::Mixed, Precision::Double),
                         precision_of);

} // namespace
} // namespace slod::test
