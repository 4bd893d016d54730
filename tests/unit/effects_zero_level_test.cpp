#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "effects/colliders.hpp"
#include "support/falling_particle.hpp"
#include "support/meshes.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

// Surfaces of grids of distances: where they are, that they have no holes, and how particles fare on them.
namespace slod::test {
namespace {

/// How often each edge is one of a triangle's.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges_of(const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Mesh::Triangle& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            ++edges[std::minmax(triangle[i], triangle[(i + 1) % 3])];
    return edges;
}

/// Expects each edge in two triangles and each place in one vertex, and returns Euler's number.
std::ptrdiff_t euler_number_of_closed(const Mesh& mesh)
{
    const auto edges = edges_of(mesh);
    for (const auto& [edge, triangles] : edges)
        EXPECT_EQ(triangles, 2) << edge.first << " to " << edge.second;
    const std::vector<std::uint32_t> first_at = first_at_each_place(mesh.vertices);
    for (std::uint32_t i = 0; i < first_at.size(); ++i)
        EXPECT_EQ(first_at[i], i);
    return std::ptrdiff_t(mesh.vertices.size()) - std::ptrdiff_t(edges.size()) +
           std::ptrdiff_t(mesh.triangles.size());
}

double area(const Mesh& mesh)
{
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += 0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
    return sum;
}

/// What a sampled ball's surface may be off by. All of a cell that it passes is at least `inner` from the
/// centre, where the distance's second derivatives are at most 1 / inner. A tetrahedron is within sqrt(3) h /
/// 2 of the middle of its diagonal, so what is linear in it is above the distance, which is convex, by at
/// most half the square of that over `inner`: the surface is inside the sphere, and by no more. Its
/// gradient's components are partial derivatives at places of the same cell, within sqrt(3) h of any in it:
/// each is off by at most sqrt(3) h / inner, and the normal by an angle whose sine is at most 3 h / inner.
struct BallBounds {
    BallBounds(double r, double h)
        : inner(r - std::sqrt(3) * h), depth(0.375 * h * h / inner), slope(3 * h / inner)
    {}
    double inner, depth, slope;
};

class SampledBall : public testing::TestWithParam<std::pair<double, double>> {
protected:
    const double radius_ = GetParam().first, spacing_ = GetParam().second;
    const Mesh mesh_ = zero_level(ball_grid(radius_, spacing_)).value();
    const BallBounds bounds_{radius_, spacing_};
};

// With points exactly on the sphere, such as (0.75, 1, 0), and without.
INSTANTIATE_TEST_SUITE_P(Spacings, SampledBall,
                         testing::Values(std::pair(1.25, 0.25), std::pair(1.0, 0.083), std::pair(1.0, 0.05)));

TEST_P(SampledBall, IsClosedAndHasNoHandle)
{
    EXPECT_EQ(euler_number_of_closed(mesh_), 2);
}

// Coordinates below 2 take ten roundings to a vertex.
TEST_P(SampledBall, HasItsVerticesWithinTheInterpolationsErrorOfTheSphere)
{
    for (const Vector3d& vertex : mesh_.vertices) {
        ASSERT_LE(vertex.norm(), radius_ + 2e-15);
        ASSERT_GE(vertex.norm(), radius_ - bounds_.depth - 2e-15);
    }
}

// The nearest places of a ball within are a map onto it that lengthens nothing. On the sphere outside, a
// triangle covers its area times at least the cosine between them.
TEST_P(SampledBall, HasTheAreaOfTheSphere)
{
    const double least = radius_ - bounds_.depth;
    EXPECT_GE(area(mesh_), 4 * std::numbers::pi * least * least);
    ASSERT_LT(bounds_.slope, 1);
    EXPECT_LE(area(mesh_),
              4 * std::numbers::pi * radius_ * radius_ / std::sqrt(1 - bounds_.slope * bounds_.slope));
}

TEST(SampledTorus, IsClosedAndHasOneHandle)
{
    const auto distance = [](const Vector3d& x) {
        return Vector3d(x.head<2>().norm() - 1, x.z(), 0).norm() - 0.4;
    };
    EXPECT_EQ(euler_number_of_closed(
                  zero_level(sampled({43, 43, 15}, {-1.5, -1.5, -0.5}, 0.0711, distance)).value()),
              0);
}

// Two planes that leave a grid of 2 by 2.2 by 2.4 by four of its sides each.
TEST(SampledPlane, IsExactAndOpenWhereItLeavesTheGrid)
{
    struct Case {
        Vector3d normal;
        double area;
    };
    for (const auto& [normal, expected] : {Case{Vector3d(0.3, -0.5, 1).normalized(), 2 * 2.2},
                                           Case{Vector3d(1, 0.2, -0.1).normalized(), 2.2 * 2.4}}) {
        const auto height = [&](const Vector3d& x) { return normal.dot(x) - 0.05; };
        const Mesh mesh = zero_level(sampled({11, 12, 13}, {-1, -1.1, -1.2}, 0.2, height)).value();
        for (const Vector3d& vertex : mesh.vertices)
            EXPECT_NEAR(height(vertex), 0, 2e-15);
        int open = 0;
        for (const auto& [edge, triangles] : edges_of(mesh)) {
            ASSERT_LE(triangles, 2);
            open += triangles == 1 ? 1 : 0;
        }
        EXPECT_GE(open, 4 * 10); // one for each cell at a side
        EXPECT_NEAR(area(mesh), expected / normal.maxCoeff(), 1e-13);
    }
}

TEST(ZeroLevel, IsEmptyWhereNothingIsBetweenInsideAndOutside)
{
    const auto triangles = [](const auto& distance) {
        return zero_level(sampled({4, 4, 4}, {0, 0, 0}, 1, distance)).value().triangles.size();
    };
    EXPECT_EQ(triangles([](const Vector3d& x) { return x.z(); }), 0U);
    EXPECT_EQ(triangles([](const Vector3d&) { return -1.0; }), 0U);
    EXPECT_EQ(triangles([](const Vector3d& x) { return x == Vector3d(1, 1, 1) ? 0.0 : -1.0; }), 0U);
}

TEST(RimEdges, AreThoseOfOneTriangleAlone)
{
    const std::vector<Vector3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(rim_edges({square, {{0, 1, 2}}}), 3U);
    EXPECT_EQ(rim_edges({square, {{0, 1, 2}, {0, 2, 3}}}), 4U);
    std::vector<Vector3d> doubled = square;
    doubled.insert(doubled.end(), square.begin(), square.end());
    EXPECT_EQ(rim_edges({doubled, {{0, 1, 2}, {4, 6, 7}}}), 4U) << "vertices at the same place are one";
    EXPECT_EQ(rim_edges(zero_level(ball_grid(1, 0.25)).value()), 0U);
}

// Points inside and outside in turn have 4 vertices each and 12 triangles to a cell; a point by itself has 14
// and 24.
TEST(ZeroLevel, IsNoneBeyondEachOfTheLimits)
{
    const auto in_turn = [](const Vector3d& x) { return int(x.sum()) % 2 == 0 ? 1.0 : -1.0; };
    const auto single = [](const Vector3d& x) {
        return int(x.x()) % 2 + int(x.y()) % 2 + int(x.z()) % 2 == 3 ? -1.0 : 1.0;
    };
    const auto is_none = [](std::size_t points, const auto& distance) {
        return !zero_level(sampled({points, points, points}, {0, 0, 0}, 1, distance));
    };
    EXPECT_FALSE(is_none(56, in_turn)); // 1,996,500 triangles
    EXPECT_TRUE(is_none(60, in_turn));  // 864,000 vertices, 2,464,548 triangles
    EXPECT_TRUE(is_none(87, single));   // 1,113,098 vertices, 1,908,168 triangles
}

/// From all sides, at any place up to `farthest` from a ball's centre, at speeds over seven decades.
struct Shot {
    Shot(double farthest, std::uint64_t i)
    {
        Random random(40, 0, i);
        const Vector3d way = random_direction(random);
        off_centre = farthest * std::sqrt(random.uniform());
        speed = std::pow(10.0, -1 + 7 * random.uniform());
        start = {-2 * way + off_centre * across(way).cross(way).normalized(), speed * way};
        time = 4 / speed;
    }
    double off_centre, speed, time;
    State start;
};

constexpr double ball_spacing = 0.04;

// The sphere has all of the sheet inside. Where a shot meets that, it has gone a little further, the longer
// the more it grazes, and the normal is no further off the middle's than where the sheet's nearest place is
// plus what half the thickness shifts that by; this holds at edges and vertices too, as the slope across them
// is bounded alike.
TEST(SampledBall, ThrowsParticlesBackAsTheSphereDoes)
{
    const double thickness = 1e-3, radius = 1 + 0.5 * thickness, restitution = 0.7;
    const BallBounds bounds(1, ball_spacing);
    const Colliders grid({with(sheet(ball_grid(1, ball_spacing), thickness), restitution, 0)}, {}, frame);
    const Colliders ball({with(sphere({0, 0, 0}, radius), restitution, 0)}, {}, frame);
    const double least = radius - bounds.depth;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const Shot shot(0.8, i);
        State a = shot.start, b = a;
        ASSERT_EQ(grid.fly(a.position, a.velocity, shot.time).impacts, 1U) << "shot " << i;
        ASSERT_EQ(ball.fly(b.position, b.velocity, shot.time).impacts, 1U) << "shot " << i;
        const double further = bounds.depth / std::sqrt(1 - std::pow(shot.off_centre / least, 2));
        const double angle = 2 * std::asin(0.5 * further / least) + std::asin(bounds.slope) + thickness;
        ASSERT_LE((a.velocity - b.velocity).norm(), (1 + restitution) * shot.speed * std::sin(angle))
            << "shot " << i;
    }
}

// Also those that only graze it, under gravity, and from its middle outwards. Who is off the sheet by half
// its thickness is off the least radius that it has by that.
TEST(SampledBall, LetsNoneInOrOut)
{
    for (const double thickness : {1e-2, 1e-5}) {
        const BallBounds bounds(1, ball_spacing);
        const Colliders colliders({with(sheet(ball_grid(1, ball_spacing), thickness), 0.5, 0.1)}, falling(),
                                  frame);
        const double least = 1 - bounds.depth + 0.5 * thickness;
        int struck = 0;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            const Shot shot(1.1, i);
            State outer = shot.start, inner{0.3 * shot.start.position.normalized(), shot.start.velocity};
            struck += colliders.fly(outer.position, outer.velocity, shot.time).impacts > 0 ? 1 : 0;
            ASSERT_GE(outer.position.norm(), least - 1e-13) << "shot " << i;
            struck += colliders.fly(inner.position, inner.velocity, shot.time).impacts > 0 ? 1 : 0;
            ASSERT_LE(inner.position.norm(), 1 - 0.5 * thickness + 1e-13) << "shot " << i;
        }
        EXPECT_GT(struck, 6000);
    }
}

/// A plane of grid points, where distances are 0 but for some noise, in a grid of 9 by 9 by 9.
class PlaneOfPoints : public testing::TestWithParam<double> {
protected:
    static constexpr double spacing = 0.5;

    Mesh mesh(const Vector3d& normal)
    {
        const auto distance = [&](const Vector3d& x) {
            const double height = normal.dot(x) / normal.norm();
            if (height == 0)
                points_.push_back(x);
            return height == 0 ? GetParam() * (2 * random_.uniform() - 1) : height;
        };
        points_.clear();
        return zero_level(sampled({9, 9, 9}, {-2, -2, -2}, spacing, distance)).value();
    }

    /// At a point, halfway to another, anywhere between them or hardly off that, in turn, not near the rim.
    Vector3d aim(int i)
    {
        for (;;) {
            const auto any = [&] { return points_[std::size_t(random_.uniform() * double(points_.size()))]; };
            const Vector3d one = any(), other = any();
            const double share = i % 4 == 0 ? 0 : i % 4 == 1 ? 0.5 : random_.uniform();
            Vector3d place = one + share * (other - one);
            if (i % 4 == 3)
                place += 1e-9 * random_direction(random_);
            if (place.cwiseAbs().maxCoeff() <= 1.5)
                return place;
        }
    }

    std::vector<Vector3d> points_; ///< of the plane
    Random random_{41, 0, 0};
};

INSTANTIATE_TEST_SUITE_P(Noise, PlaneOfPoints,
                         testing::Values(0, 1e-17, 1e-15, 1e-12, 4e-7, 6e-7, 1e-5, 1e-3));

// From both sides, along and across the diagonals that cells are cut by. Noise is small beside what a bounce
// leaves of the way, 0.04. What is taken for 0 leaves a plane; on its edges half the thickness is told from
// rounding, fifty of a coordinate of 2, to 5e-9, and the angle that it turns by twice.
TEST_P(PlaneOfPoints, HasNoHoles)
{
    for (const Vector3d& normal :
         {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(1, -1, 0), Vector3d(1, 1, 0), Vector3d(1, 1, 1),
          Vector3d(-1, 1, 1), Vector3d(1, -2, 1)}) {
        const Colliders colliders({with(sheet(mesh(normal), 1e-5), 1, 0)}, {}, frame);
        const Vector3d up = normal.normalized();
        int checked = 0;
        for (int i = 0; i < 6000; ++i) {
            const Vector3d place = aim(i), direction = random_direction(random_);
            const double steepness = up.dot(direction), speed = std::pow(10.0, 2 + 4 * random_.uniform());
            if (std::abs(steepness) < 0.2)
                continue;
            State state{place + 0.4 * direction, -speed * direction};
            const auto met = colliders.fly(state.position, state.velocity, 0.8 / speed);
            ASSERT_GE(met.impacts, 1U) << normal.transpose() << ", shot " << i;
            ASSERT_GT(up.dot(state.position) * steepness, 0) << normal.transpose() << ", shot " << i;
            if (GetParam() <= 1e-6 * spacing) {
                ASSERT_EQ(met.impacts, 1U) << normal.transpose() << ", shot " << i;
                const Vector3d mirrored = speed * (2 * steepness * up - direction);
                ASSERT_LE((state.velocity - mirrored).norm(), 1e-7 * speed)
                    << normal.transpose() << ", shot " << i;
            }
            ++checked;
        }
        EXPECT_GT(checked, 4000);
    }
}

/// Noise that is taken for 0.
class PlaneWithinRounding : public PlaneOfPoints {};

INSTANTIATE_TEST_SUITE_P(Noise, PlaneWithinRounding, testing::Values(0, 1e-17, 1e-15, 1e-12, 4e-7));

// Over points, along edges and diagonals and across them, where the plane is turned. As on any sheet, each of
// less than 200 seams shifts what slides by no more than the tolerance of contacts, 3e-14 for places below 3.
TEST_P(PlaneWithinRounding, LetsParticlesSlideAsOnAPlane)
{
    ColliderSettings floor = turned(sheet(mesh({0, 0, 1}), 2e-3), {20, 30, 40});
    const Matrix3d turn = rotation_of(floor);
    UniformFields fields;
    fields.gravity = turn * Vector3d(0, 0, -fall);
    const Colliders colliders({with(floor, 0.3, 0)}, fields, frame);
    for (const State& start :
         {State{{-1.5, -1.5, 1e-3}, {2.5, 2.5, 0}}, State{{-1.5, 0.5, 1e-3}, {2.5, 0, 0}},
          State{{0.5, 1.5, 1e-3}, {0, -2.5, 0}}, State{{-1.41, -1.3, 1e-3}, {2.2, 1.9, 0}}}) {
        State slides{turn * start.position, turn * start.velocity};
        for (int step = 1; step <= 70; ++step) {
            ASSERT_FALSE(colliders.fly(slides.position, slides.velocity, frame).cut_off) << "frame " << step;
            const Vector3d expected = turn * (start.position + step * frame * start.velocity);
            ASSERT_LE((slides.position - expected).norm(), 201 * 3e-14) << "frame " << step;
        }
    }
}

} // namespace
} // namespace slod::test
