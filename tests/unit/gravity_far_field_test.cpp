#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "gravity/branch_walk.hpp"
#include "gravity/far_field.hpp"
#include "support/attracting_world.hpp"
#include "support/clouds.hpp"

// Expansions of far nodes, against the sums over targets one by one that they stand for.
namespace slod::test {
namespace {

constexpr std::size_t tile = simd::tile_width;
const Vector3d middle(3, -2, 1); ///< of the targets

struct FarNode {
    ForceView::Node node;
    Symmetric3 moments;
};

/// Nodes of a radius of some 0.3, at distances from 2 to 6 of the middle.
std::vector<FarNode> far_nodes(std::size_t count, bool extended)
{
    std::vector<FarNode> nodes(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(7, 0, i);
        Vector3d direction = point_in_ball(random, 1);
        direction.normalize();
        FarNode& far = nodes[i];
        far.node.centre = middle + (2 + 4 * random.uniform()) * direction;
        far.node.mass = 0.5 + random.uniform();
        far.node.q = 0.1 * random.uniform();
        for (int part = 0; extended && part < 3; ++part) {
            const Vector3d offset = point_in_ball(random, 0.3);
            far.moments = Symmetric3::of(far.moments.matrix() + offset * offset.transpose() / 3);
        }
    }
    return nodes;
}

/// Sums for a tile of targets, their places in a ball about the middle.
template <class Real>
struct TileOf {
    KernelBodies<Real, tile> bodies;
    std::array<std::array<Real, tile>, 9> sums{};

    TileOf(double reach, double q)
    {
        for (std::size_t i = 0; i < tile; ++i) {
            Random random(3, 0, i);
            bodies.put(i, i == 0 ? Vector3d(0, 0, 0) : point_in_ball(random, reach), 1, q, {});
        }
    }

    simd::GravityTargets<Real> targets(bool tide = true)
    {
        const auto& b = bodies;
        const auto of_tide = [&](std::size_t sum) { return tide ? sums[sum].data() : nullptr; };
        return {tile,           b.x.data(),     b.y.data(),     b.z.data(), b.q.data(),
                sums[0].data(), sums[1].data(), sums[2].data(), of_tide(3), of_tide(4),
                of_tide(5),     of_tide(6),     of_tide(7),     of_tide(8)};
    }
};

using Tile = TileOf<double>;

/// Largest difference of two tiles' accelerations.
double difference(const Tile& a, const Tile& b, std::size_t first_target = 0, std::size_t last_sum = 3)
{
    double largest = 0;
    for (std::size_t sum = 0; sum < last_sum; ++sum)
        for (std::size_t i = first_target; i < tile; ++i)
            largest = std::max(largest, std::abs(a.sums[sum][i] - b.sums[sum][i]));
    return largest;
}

ForceView::Node ball_of_targets(double reach, double q)
{
    ForceView::Node targets;
    targets.centre = middle;
    targets.radius = float(reach);
    targets.q = q;
    return targets;
}

Tile one_by_one(const std::vector<FarNode>& nodes, double reach, double q)
{
    Tile sums(reach, q);
    for (const FarNode& far : nodes) {
        KernelNodes<double, 1> list;
        list.put(0, far.node.centre - middle, far.node.mass, far.node.q, {});
        list.put_moments(0, far.moments, {});
        simd::kernels().in_double.add_nodes_acceleration_and_tide(sums.targets(), list.list(1));
    }
    return sums;
}

Expansion expand(const std::vector<FarNode>& nodes, double reach, double q)
{
    FarField<double> far(simd::kernels().in_double, {});
    far.begin(ball_of_targets(reach, q));
    for (const FarNode& node : nodes)
        far.add(node.node, node.moments);
    return far.sum();
}

Tile by_expansion(const std::vector<FarNode>& nodes, double reach, double q)
{
    Tile sums(reach, q);
    simd::kernels().in_double.add_expansion(sums.targets(), expand(nodes, reach, q));
    return sums;
}

// In the middle nothing is left out: pull and tide are those of the nodes, to the rounding of 300 terms.
TEST(FarField, IsExactInTheMiddleForPullAndTide)
{
    const auto nodes = far_nodes(300, true);
    const Tile expected = one_by_one(nodes, 0, 0.02), sums = by_expansion(nodes, 0.5, 0.02);
    for (std::size_t sum = 0; sum < 9; ++sum)
        EXPECT_NEAR(sums.sums[sum][0], expected.sums[sum][0], 300 * 0x1p-50) << sum;
}

// Half the reach leaves a sixteenth of the error: the fourth power is the first that is missing. Of nodes
// with second moments it is the second power of what they add, a quarter.
TEST(FarField, MissesTheFourthPowerOfTheOffset)
{
    for (const bool extended : {false, true}) {
        const auto nodes = far_nodes(300, extended);
        const auto error = [&](double reach) {
            return difference(by_expansion(nodes, reach, 0.02), one_by_one(nodes, reach, 0.02));
        };
        EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), extended ? 2 : 4, 0.1);
    }
}

TEST(FarField, TheTideIsTheDerivativeOfThePull)
{
    Tile here(0, 0), beside(0, 0);
    const Expansion expansion = expand(far_nodes(20, true), 0.5, 0);
    constexpr double step = 1e-5;
    here.bodies.x.fill(0.2 - step);
    beside.bodies.x.fill(0.2 + step);
    simd::kernels().in_double.add_expansion(here.targets(), expansion);
    simd::kernels().in_double.add_expansion(beside.targets(), expansion);
    for (std::size_t i = 0; i < 3; ++i) // of the third derivative, some 50, a sixth step^2
        EXPECT_NEAR((beside.sums[i][0] - here.sums[i][0]) / (2 * step),
                    (here.sums[3 + i][0] + beside.sums[3 + i][0]) / 2, 1e-8);
}

TEST(FarField, IsTheSamePolynomialAboutAnotherPoint)
{
    const Vector3d offset(0.1, -0.2, 0.05);
    const Expansion expansion = expand(far_nodes(20, true), 0.5, 0),
                    elsewhere = moved(expansion, offset, 0.125);
    Tile here(0.5, 0), there(0.5, 0);
    for (std::size_t i = 0; i < tile; ++i) {
        there.bodies.x[i] -= offset.x();
        there.bodies.y[i] -= offset.y();
        there.bodies.z[i] -= offset.z();
    }
    simd::kernels().in_double.add_expansion(here.targets(), expansion);
    simd::kernels().in_double.add_expansion(there.targets(), elsewhere);
    EXPECT_LE(difference(here, there, 0, 9), 1e-12);
}

template <class Real>
void expect_same_bits()
{
    const auto nodes = far_nodes(300, true);
    const auto sums = [&](const simd::KernelTable& table) {
        FarField<Real> far(simd::gravity_kernels<Real>(table), {});
        far.begin(ball_of_targets(0.5, 0.02));
        for (const FarNode& node : nodes)
            far.add(node.node, node.moments);
        return far.sum();
    };
    const Expansion baseline = sums(*simd::kernels("baseline"));
    for (const simd::KernelTable* table : simd::runnable_kernels()) {
        const Expansion other = sums(*table);
        EXPECT_EQ(std::memcmp(&other, &baseline, sizeof baseline), 0) << table->name;
        simd::FarExpansion<Real> terms{};
        terms.reach = Real(other.reach);
        std::copy(std::begin(other.pull), std::end(other.pull), terms.pull);
        std::copy(std::begin(other.tide), std::end(other.tide), terms.tide);
        std::copy(std::begin(other.third), std::end(other.third), terms.third);
        std::copy(std::begin(other.fourth), std::end(other.fourth), terms.fourth);
        TileOf<Real> expected(0.5, 0);
        simd::gravity_kernels<Real>(*simd::kernels("baseline")).add_expansion(expected.targets(), terms);
        for (const bool tide : {true, false}) {
            TileOf<Real> sums_here(0.5, 0);
            simd::gravity_kernels<Real>(*table).add_expansion(sums_here.targets(tide), terms);
            EXPECT_EQ(std::memcmp(&sums_here.sums, &expected.sums, (tide ? 9 : 3) * sizeof expected.sums[0]),
                      0)
                << table->name << (tide ? "" : ", without the tide");
        }
    }
}

TEST(FarField, HasTheSameBitsOnEveryInstructionSet)
{
    expect_same_bits<float>();
    expect_same_bits<double>();
}

// A heavy ball and light bodies whose softening is forty times as long, far from it. An expansion about
// groups of both must not pull them with the heavy ones' softening.
TEST(BranchWalk, LightAndMasslessBodiesKeepTheirOwnSoftening)
{
    for (const float mass : {0.0F, 1e-6F}) {
        ParticleSet particles = ball(4000, 0.3, 0, 1);
        for (Particle& particle : particles)
            particle.mass = 1 / 4000.0F;
        for (Particle light : ball(12'000, 4, 0, 2)) {
            light.id += 4000;
            light.mass = mass;
            light.kind = std::uint8_t(light.id % 2 == 0 ? 2 : 0); // softened ten times as much as kind 0
            particles.push_back(light);
        }
        AttractingWorld world = walked(particles, 0.1);
        world.settings.multipoles = Multipoles::Quadrupole;
        world.rebuild();
        EXPECT_GT(world.evaluate_again().far_nodes, 0U);
        EXPECT_LT(force_errors(world).p99, 2e-3) << "twice the tolerance";
    }
}

// What is not settled above is settled by the groups: nothing is lost, it takes longer.
TEST(BranchWalk, WithoutRoomForListsGroupsDoAllTheWork)
{
    AttractingWorld world = walked(plummer_sphere(20'000, 1));
    world.settings.multipoles = Multipoles::Quadrupole;
    world.rebuild();
    const ForceCounts usual = world.evaluate_again();
    const auto run = [&](std::size_t room) {
        const ForceTerms<float> terms{world.view, simd::kernels().in_float, world.settings, 1,
                                      units_of(world.view)};
        BranchWalk<float> walk(terms, 0, world.clusters(), room);
        return walk.run(0);
    };
    for (const std::size_t room : {0UL, 1UL, 100UL}) {
        const ForceCounts counts = run(room);
        EXPECT_EQ(counts.groups, usual.groups);
        EXPECT_GT(counts.nodes_tested, usual.nodes_tested);
        EXPECT_LT(force_errors(world).p99, 5e-3);
    }
}

} // namespace
} // namespace slod::test
