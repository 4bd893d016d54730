#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/falling_particle.hpp"
#include "support/meshes.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

// How a single particle fares on sheets of triangles: as on the solid that they make, seams or not.
namespace slod::test {
namespace {

double energy(const State& state)
{
    return 0.5 * state.velocity.squaredNorm() + fall * state.position.z();
}

/// Whether something at `place` on a box about the origin is within `reach` of an edge.
bool near_edge(const Vector3d& place, const Vector3d& half_extent, double reach)
{
    return ((place.cwiseAbs() - half_extent).array() > -reach).count() > 1;
}

// The sheet is laid half a thickness within the box, so that its faces are the box's, and its edges are
// round. Places are below 4, so each finds its contact within 4e-14 of the surface, and the normals within
// ten roundings; without forces, a surface that is off by so much moves the end by (1 + e) (1 + friction) of
// it.
TEST(BoxOfTwelveTriangles, IsStruckAsTheBoxIs)
{
    const Vector3d half(0.7, 0.4, 0.5);
    const double thickness = 1e-3;
    const Vector3d inner = half.array() - 0.5 * thickness;
    const ColliderSettings solid = with(box({0, 0, 0}, half), 0.5, 0.3);
    const Colliders of_box({solid}, {}, frame);
    const Colliders of_mesh({with(sheet(box_mesh(inner), thickness), 0.5, 0.3)}, {}, frame);
    Random random(1, 0, 0);
    int struck = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Vector3d start = 2 * random_direction(random),
                       aim = random.uniform() * random_direction(random);
        State a{start, 2 * (aim - start) / frame}, b = a;
        const Path path{a.position, a.velocity, {0, 0, 0}, 0};
        const double time = first_contact(path, *make_solid(solid), 0, Elapsed(0, frame), false);
        if (time <= frame && near_edge(path.position_after(Elapsed(0, time)), half, thickness))
            continue;
        const auto met_a = of_box.fly(a.position, a.velocity, frame);
        const auto met_b = of_mesh.fly(b.position, b.velocity, frame);
        if (near_edge(path.position, half, thickness))
            continue;
        ASSERT_EQ(met_a.impacts, met_b.impacts) << "draw " << i;
        ASSERT_LE((a.position - b.position).norm(), 4e-13) << "draw " << i;
        ASSERT_LE((a.velocity - b.velocity).norm(), 1e-14 * path.velocity.norm()) << "draw " << i;
        struck += met_a.impacts > 0 ? 1 : 0;
    }
    EXPECT_GT(struck, 5'000);
}

/// A floor of 60 by 60 squares of 5 cm and the plane that it is, level and turned.
class FlatSheet : public testing::TestWithParam<bool> {
protected:
    static constexpr double thickness = 2e-3, height = 0.5 * thickness;

    std::vector<ColliderSettings> mesh(double restitution, double friction) const
    {
        Mesh flat = flat_mesh(61, 61, 0.05);
        for (Vector3d& vertex : flat.vertices)
            vertex = turn_ * vertex;
        return {with(sheet(flat, thickness), restitution, friction)};
    }
    std::vector<ColliderSettings> floor(double restitution, double friction) const
    {
        return {with(plane(turn_ * Vector3d(0, 0, height), turn_.col(2)), restitution, friction)};
    }

    /// Flies both for so many frames and expects them together. On each seam that one crosses its height is
    /// off by rounding, which each time changes the rest by as much: `seams` times 3e-14, the tolerance of
    /// contacts where places are below 3.
    void expect_same(const State& start, double restitution, double friction, int frames, double seams,
                     UniformFields fields = falling()) const
    {
        fields.gravity = turn_ * fields.gravity;
        const Colliders on_mesh(mesh(restitution, friction), fields, frame);
        const Colliders on_plane(floor(restitution, friction), fields, frame);
        State a{turn_ * start.position, turn_ * start.velocity}, b = a;
        double apart = 0;
        for (int i = 0; i < frames; ++i) {
            const auto met = on_mesh.fly(a.position, a.velocity, frame);
            on_plane.fly(b.position, b.velocity, frame);
            ASSERT_FALSE(met.cut_off) << "frame " << i;
            ASSERT_LE((a.velocity - b.velocity).norm(), (seams + 1) * 3e-14 / frame) << "frame " << i;
            apart = std::max(apart, (a.position - b.position).norm());
        }
        expect_at_most("distance from one on a plane", apart, (seams + 1) * 3e-14);
    }

    const Matrix3d turn_ = GetParam()
                               ? Eigen::Quaterniond(0.9, 0.2, -0.3, 0.4).normalized().toRotationMatrix()
                               : Matrix3d(Matrix3d::Identity());
};

INSTANTIATE_TEST_SUITE_P(LevelAndTurned, FlatSheet, testing::Bool());

// Across squares, along a row of edges, along the diagonals, and over vertices.
TEST_P(FlatSheet, F11_LetsParticlesSlideOverItsSeamsAsOnAPlane)
{
    const std::vector<State> starts{{{0.11, 0.23, height}, {2, 1.7, 0}},
                                    {{0.11, 0.25, height}, {2.5, 0, 0}},
                                    {{0.25, 0.25, height}, {2, 2, 0}},
                                    {{0.25, 1, height}, {0, 1.9, 0}},
                                    {{2.5, 0.2, height}, {-2, 2, 0}}};
    for (const State& start : starts) {
        expect_same(start, 0.3, 0, 60, 200);
        expect_same(start, 0.3, 0.1, 90, 200);
        expect_same(start, 0, 0.6, 120, 200);
    }
}

TEST_P(FlatSheet, F11_LetsWhatMovesAlongItWithoutWeightPass)
{
    expect_same({{0.11, 0.23, height}, {1.9, 1.7, 0}}, 1, 0, 80, 200, {});
    expect_same({{0.25, 0.25, height}, {2, 2, 0}}, 1, 0, 80, 200, {});
}

TEST_P(FlatSheet, LetsParticlesBounceAndRestAsOnAPlane)
{
    // An impact's moment is off by 3e-14 over the speed, so that each of some ten changes the next speed by
    // 10 of 3e-14 over that of the slowest, a hundredth.
    for (const Vector3d& place : {Vector3d(1.01, 0.98, 0.4), Vector3d(1, 1, 0.4), Vector3d(1.025, 1, 0.4),
                                  Vector3d(1.025, 1.025, 0.4)}) {
        expect_same({place, {0.3, 0.2, -1}}, 0.5, 0.2, 200, 1e5);
        expect_same({place, {0, 0, 0}}, 0.3, 0.5, 200, 1e5);
    }
}

TEST_P(FlatSheet, CountsOneImpactOnAnEdgeOrAVertex)
{
    const Colliders colliders(mesh(1, 0), {}, frame);
    for (const Vector3d& aim : {Vector3d(1, 1, height), Vector3d(1.025, 1, height),
                                Vector3d(1.025, 1.025, height), Vector3d(1, 1.025, height)}) {
        for (const Vector3d& from : {Vector3d(0, 0, 1), Vector3d(0.3, 0.4, 0.5), Vector3d(-0.7, 0, 0.01)}) {
            State state{turn_ * (aim + from), turn_ * (-2 * from / frame)};
            const auto met = colliders.fly(state.position, state.velocity, frame);
            EXPECT_EQ(met.impacts, 1U) << aim.transpose() << " from " << from.transpose();
            const Vector3d mirrored = aim + Vector3d(-from.x(), -from.y(), from.z());
            EXPECT_LE((state.position - turn_ * mirrored).norm(), 1e-12);
        }
    }
}

struct Wall {
    double speed, thickness;
};

/// On a vertex, on an edge or within the triangle, in turn, and at times off by a little.
Vector3d aim_at(const Mesh& mesh, int i, Random& random)
{
    const auto& triangle = mesh.triangles[std::size_t(random.uniform() * double(mesh.triangles.size()))];
    const auto corner = [&](int k) { return mesh.vertices[triangle[std::size_t(k)]]; };
    const double u = i % 3 == 0 ? 0 : random.uniform(), v = i % 3 == 2 ? random.uniform() : 0;
    const Vector3d aim = corner(0) + u * (corner(1) - corner(0)) + (1 - u) * v * (corner(2) - corner(0));
    return i % 7 == 0 ? Vector3d(aim + 1e-9 * random_direction(random)) : aim;
}

// Aimed at any place, at edges and at vertices, exactly and less so, from both sides.
TEST(ThinSheet, F10_LetsNoneThrough)
{
    const Mesh mesh = hilly_mesh();
    int through = 0;
    for (const Wall& wall : {Wall{200, 0.1}, Wall{1e4, 1e-3}, Wall{1e4, 1e-5}}) {
        const Colliders colliders({with(sheet(mesh, wall.thickness), 0.5, 0.1)}, falling(), frame);
        Random random(4, 0, 0);
        for (int i = 0; i < 100'000; ++i) {
            const Vector3d aim = aim_at(mesh, i, random);
            if ((aim.head<2>().array() < 0.01).any() || (aim.head<2>().array() > 3.99).any())
                continue; // where it could go around
            Vector3d direction = random_direction(random);
            while (std::abs(direction.z()) < 0.8) // else it might start within a hill
                direction = random_direction(random);
            const double side = direction.z() > 0 ? 1 : -1;
            State state{aim + 0.6 * direction, -wall.speed * direction};
            const auto met = colliders.fly(state.position, state.velocity, 1.2 / wall.speed);
            ASSERT_GE(met.impacts, 1U) << "particle " << i << " at speed " << wall.speed;
            const std::optional<double> ground = hilly_height(state.position);
            if (!ground)
                continue;
            through += side * (state.position.z() - *ground) > 0 ? 0 : 1;
        }
    }
    expect_at_most("particles through", through, 0);
}

// Elastic bounces over hills; each rounds energies of about 30 some tens of times.
TEST(HillySheet, F12_KeepsTheEnergyOfElasticBounces)
{
    const Mesh rough = grid_mesh(41, 41, 0.25, [](auto x, auto y) { return 0.05 * ((x * 5 + y * 3) % 4); });
    std::vector<ColliderSettings> scene{with(sheet(rough, 0.01), 1, 0)};
    for (const double side : {-1.0, 1.0}) {
        for (int axis = 0; axis < 2; ++axis) {
            const Vector3d normal = side * Vector3d::Unit(axis);
            scene.push_back(with(plane({side > 0 ? 0.1 : 9.9, side > 0 ? 0.1 : 9.9, 0}, normal), 1, 0));
        }
    }
    const Colliders colliders(scene, falling(), frame);
    Random random(5, 0, 0);
    for (int i = 0; i < 50; ++i) {
        State state{{1 + 8 * random.uniform(), 1 + 8 * random.uniform(), 2}, 3 * random_direction(random)};
        const double before = energy(state);
        std::uint32_t impacts = 0;
        for (int step = 0; step < 1200; ++step) {
            const auto met = colliders.fly(state.position, state.velocity, frame);
            impacts += met.impacts;
            ASSERT_FALSE(met.cut_off);
        }
        // What bounces so low that it rests, for a frame or for good, loses no more than that.
        expect_at_most("error of the energy per impact, share",
                       std::abs(energy(state) / before - 1) / impacts, 1e-11);
        EXPECT_GT(impacts, 10U);
        EXPECT_GT(state.position.z(), 0);
    }
}

// Two slopes of two triangles each that meet at the bottom, and the seam as exactly hit as it can be.
TEST(SheetWithAValley, HoldsParticlesAtItsSeam)
{
    for (const double steepness : {0.02, 0.5, 5.0}) {
        const Mesh valley =
            grid_mesh(3, 5, 1, [&](auto x, auto) { return steepness * std::abs(double(x) - 1.0); });
        const Colliders colliders({with(sheet(valley, 0.01), 0.2, 0)}, falling(), frame);
        for (const double off : {0.0, 1e-3, 0.05}) {
            State state{{1 + off, 1.5, 0.1 + steepness * off}, {0, 0, 0}};
            for (int step = 0; step < 3600; ++step) {
                const double before = energy(state);
                colliders.fly(state.position, state.velocity, frame);
                ASSERT_LE(energy(state), before + 1e-12);
            }
            EXPECT_LE(state.velocity.norm(), 0.2) << steepness;
            EXPECT_LE(std::abs(state.position.x() - 1), 0.1) << steepness;
            EXPECT_GE(state.position.z(), 0.0049) << steepness;
            EXPECT_NEAR(state.position.y(), 1.5, 1e-9) << steepness;
        }
        // Along the seam, where both slopes hold it.
        State slides{{1, 0.1, 0.005 * std::sqrt(1 + steepness * steepness)}, {0, 2, 0}};
        for (int step = 0; step < 100; ++step)
            ASSERT_FALSE(colliders.fly(slides.position, slides.velocity, frame).cut_off);
        EXPECT_NEAR(slides.position.y(), 0.1 + 2 * 100 * frame, 1e-10) << steepness;
        EXPECT_NEAR(slides.position.x(), 1, 1e-10) << steepness;
    }
}

// Through a trough whose floor turns by 1.35 in forty seams. Each takes the part of the velocity that leads
// into the next floor, 1 - cos^2 of the angle of the energy: a share of 1.35^2 / 40 = 0.046 in all.
TEST(SheetWithAValley, LetsWhatSlidesPassFromSlopeToSlope)
{
    const Mesh trough = grid_mesh(41, 3, 0.05, [](auto x, auto) { return 0.4 * std::pow(0.05 * x - 1, 2); });
    const Colliders colliders({with(sheet(trough, 0.01), 0, 0)}, falling(), frame);
    State state{{0.1, 0.04, 0.4}, {0, 0, 0}};
    double farthest = 0;
    for (int step = 0; step < 120; ++step) {
        ASSERT_FALSE(colliders.fly(state.position, state.velocity, frame).cut_off) << "frame " << step;
        farthest = std::max(farthest, state.position.x());
    }
    // It falls 0.07 and loses most of what that gives across the slope: 0.07 sin^2 of 0.62 is left. Its
    // height of 0.32 above the bottom is 0.34 then, and 0.32 on the other side.
    EXPECT_GE(farthest, 1 + std::sqrt(0.31 / 0.4));
    EXPECT_LE(farthest, 1 + std::sqrt(0.35 / 0.4));
}

// Uphill over a seam so slight that it lifts more slowly than what comes to rest.
TEST(SheetWithAValley, LetsWhatSlidesUphillPassASlightSeam)
{
    for (const double turn : {1e-7, 1e-5, 1e-3}) {
        const Mesh slopes = grid_mesh(3, 3, 1, [&](auto x, auto) { return 0.1 * x + (x > 1 ? turn : 0); });
        const Colliders colliders({with(sheet(slopes, 0.01), 0, 0)}, falling(), frame);
        const double lift = 0.005 * std::sqrt(1 + 0.1 * 0.1);
        State state{{0.5, 0.8, 0.05 + lift}, 1.5 * Vector3d(1, 0.1, 0.1).normalized()};
        const double before = energy(state);
        for (int step = 0; step < 40; ++step)
            ASSERT_FALSE(colliders.fly(state.position, state.velocity, frame).cut_off) << turn;
        EXPECT_GT(state.position.x(), 1.2) << turn;
        // The seam takes the square of its angle of an energy of about 1.
        EXPECT_NEAR(energy(state), before, turn * turn + 1e-10) << turn;
    }
}

TEST(ThinSheet, F20_PutsWhatStartsInsideOntoItsNearerSideWithoutSpeed)
{
    const Colliders colliders({sheet(flat_mesh(5, 5, 1), 0.2)}, {}, frame);
    Random random(6, 0, 0);
    double off = 0, fastest = 0;
    for (int i = 0; i < 2000; ++i) {
        State state{{4 * random.uniform(), 4 * random.uniform(), 0.2 * (random.uniform() - 0.5)}, {0, 0, 0}};
        const double side = state.position.z() > 0 ? 0.1 : -0.1;
        colliders.fly(state.position, state.velocity, frame);
        off = std::max(off, std::abs(state.position.z() - side));
        fastest = std::max(fastest, state.velocity.norm());
    }
    expect_at_most("distance from the nearer side after a frame", off, 1e-14);
    expect_at_most("speed given", fastest, 0);
}

} // namespace
} // namespace slod::test
