#include <cmath>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "effects/colliders.hpp"
#include "support/case_rows.hpp"
#include "support/meshes.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

// Where sheets of triangles are, and what is found of them.
namespace slod::test {
namespace {

constexpr double thickness = 0.02;
/// Coordinates are below 4; a plate takes some twenty roundings to a distance, and its triangles are not so
/// thin that the normal loses more.
constexpr double rounding = 40 * 4 * 0x1p-52;

/// Some triangles in no symmetric position that meet at edges and at one vertex.
Mesh fan()
{
    return {{{0.1, 0.2, 0.3}, {1.1, 0, 0.2}, {0.3, 0.9, -0.1}, {-0.8, 0.4, 0.5}, {-0.2, -0.7, 0.1}},
            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
}

Vector3d random_place(Random& random)
{
    return 2 * random.uniform() * random_direction(random);
}

// As a solid of its own, a plate keeps what makes the steps from plane to plane safe.
TEST(Plate, IsConvexAndWhereItsDistanceSays)
{
    const Sheet sheet(fan(), thickness);
    Random random(1, 0, 0);
    for (int i = 0; i < 20'000; ++i) {
        const Plate plate(sheet, std::uint32_t(i) % sheet.plate_count());
        const Vector3d x = random_place(random), y = random_place(random);
        const Surface at_x = plate.surface(x), at_y = plate.surface(y);
        ASSERT_NEAR(at_x.normal.norm(), 1, rounding);
        ASSERT_NEAR(plate.surface(x - at_x.distance * at_x.normal).distance, 0, rounding);
        ASSERT_LE(std::abs(at_x.distance - at_y.distance), (x - y).norm() + rounding);
        if (at_x.distance > 0) {
            ASSERT_GE(at_y.distance, at_x.distance + at_x.normal.dot(y - x) - rounding);
        }
    }
}

// By the nearest of many points of the triangle, which are at most a hundredth of its sides apart.
TEST(Plate, IsAtTheDistanceOfTheNearestPointOfItsTriangle)
{
    const Mesh mesh = fan();
    const Sheet sheet(mesh, thickness);
    Random random(2, 0, 0);
    for (int i = 0; i < 200; ++i) {
        const std::uint32_t index = std::uint32_t(i) % sheet.plate_count();
        const auto corner = [&](int k) { return mesh.vertices[mesh.triangles[index][std::size_t(k)]]; };
        const Vector3d x = random_place(random);
        double nearest = 1e9;
        for (int a = 0; a <= 100; ++a)
            for (int b = 0; a + b <= 100; ++b)
                nearest = std::min(nearest, (corner(0) + a / 100.0 * (corner(1) - corner(0)) +
                                             b / 100.0 * (corner(2) - corner(0)) - x)
                                                .norm());
        const double distance = Plate(sheet, index).surface(x).distance + thickness / 2;
        ASSERT_LE(distance, nearest + rounding);
        ASSERT_GE(distance, nearest - 0.02);
    }
}

TEST(Sheet, HasNormalsToBothSides)
{
    const Sheet sheet(flat_mesh(2, 2, 1), thickness);
    for (const double side : {1.0, -1.0}) {
        const Surface surface = Plate(sheet, 0).surface({0.6, 0.3, side * 0.5});
        EXPECT_NEAR(surface.distance, 0.49, rounding);
        EXPECT_EQ(surface.normal, Vector3d(0, 0, side));
    }
}

TEST(Sheet, LeavesOutTrianglesWithoutAreaAndJoinsVerticesAtOnePlace)
{
    Mesh mesh = flat_mesh(2, 2, 1);
    mesh.triangles.push_back({0, 0, 1});
    EXPECT_EQ(Sheet(mesh, thickness).plate_count(), 2U);
    // Beside the first triangle's diagonal, and so near that it is within rounding of both: the second one,
    // whose vertices are others at the same places, is the nearer one.
    Mesh apart;
    for (const Mesh::Triangle& triangle : flat_mesh(2, 2, 1).triangles) {
        const auto first = std::uint32_t(apart.vertices.size());
        for (const std::uint32_t vertex : triangle)
            apart.vertices.push_back(mesh.vertices[vertex]);
        apart.triangles.push_back({first, first + 1, first + 2});
    }
    const Sheet joined(apart, thickness);
    const Vector3d x(0.5 - 1e-9, 0.5 + 1e-9, thickness / 2);
    EXPECT_GT(Plate(joined, 0).cover(x).count, 0);
    EXPECT_EQ(Plate(joined, 1).cover(x).count, 0);
}

TEST(BoxTree, FindsAllThatASweepMeets)
{
    Random random(3, 0, 0);
    std::vector<Box> boxes;
    for (int i = 0; i < 3000; ++i) {
        const Vector3d lower = 10 * random_place(random);
        boxes.push_back({lower, lower + random.uniform() * Vector3d(1, 2, 0.5)});
    }
    const BoxTree tree(boxes);
    std::size_t met = 0, visited = 0;
    for (int i = 0; i < 300; ++i) {
        const Vector3d from = 10 * random_place(random);
        // Some along an axis, or of no length.
        const Vector3d way = i % 3 == 0   ? Vector3d(10 * random_place(random))
                             : i % 3 == 1 ? Vector3d(0, -7, 0)
                                          : Vector3d(0, 0, 0);
        const Sweep sweep(from, from + way, Vector3d::Constant(0.1));
        std::set<std::uint32_t> found;
        tree.any(sweep, [&](std::uint32_t index) {
            ++visited;
            EXPECT_TRUE(found.insert(index).second) << "box " << index << " twice";
            return false;
        });
        for (std::uint32_t index = 0; index < boxes.size(); ++index) {
            if (!sweep.meets(boxes[index]))
                continue;
            ++met;
            ASSERT_TRUE(found.contains(index)) << "box " << index;
        }
        // A point of the way that is in a box is proof that the sweep meets it.
        const Vector3d on_way = from + random.uniform() * way;
        for (std::uint32_t index = 0; index < boxes.size(); ++index)
            ASSERT_TRUE(!boxes[index].contains(on_way) || found.contains(index)) << "box " << index;
    }
    EXPECT_GT(met, 300U);
    EXPECT_LT(visited, 300 * boxes.size() / 10) << "it looked at almost everything";
}

TEST(BoxTree, StopsWhenTheVisitorSaysSo)
{
    const BoxTree tree(std::vector<Box>(100, Box{{0, 0, 0}, {1, 1, 1}}));
    const Sweep sweep({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0, 0, 0});
    int visits = 0;
    EXPECT_TRUE(tree.any(sweep, [&](std::uint32_t) { return ++visits == 3; }));
    EXPECT_EQ(visits, 3);
    EXPECT_FALSE(BoxTree({}).any(sweep, [](std::uint32_t) { return true; }));
}

TEST(ColliderSettings, F25_AreRefusedWhereTheyLeaveNoSheet)
{
    int refused = 0;
    const auto says = [&](const ColliderSettings& collider, const std::string& start) {
        const Problems found = problems(collider);
        const bool does = found.size() == 1 && found.front().starts_with(start);
        refused += does ? 1 : 0;
        return does;
    };
    ColliderSettings sound = sheet(flat_mesh(2, 2, 100));
    EXPECT_EQ(problems(sound), Problems{});
    ColliderSettings faulty = sound;
    faulty.mesh.reset();
    EXPECT_TRUE(says(faulty, "file = \"\" names none; use that"));
    faulty = sound;
    faulty.scale = 0;
    EXPECT_TRUE(says(faulty, "scale = 0 leaves no surface; use"));
    faulty = sound;
    faulty.thickness = 5e-5; // half a millionth of 100
    EXPECT_TRUE(says(faulty, "thickness = 5e-05 is no more than what rounding may pass; use more than "));
    faulty = sound;
    faulty.shape = ColliderShape::Heightfield;
    faulty.spacing = 0;
    EXPECT_TRUE(says(faulty, "spacing = 0 leaves no surface; use"));
    expect_at_least("degenerate sheets refused, of 4", refused, 4);
}

// A vertex twice, and three in line.
TEST(ColliderSettings, F25_AreRefusedWhereNoTriangleHasAnArea)
{
    const std::vector<Vector3d> vertices{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 1, 0}};
    ColliderSettings line = sheet({vertices, {{0, 0, 3}, {0, 1, 2}}});
    line.file = "line.obj";
    const Problems found = problems(line);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found.front().starts_with("file = \"line.obj\": no triangle in it has an area; give it"))
        << found.front();
    expect_at_least("meshes without an area refused, of 1", double(found.size()), 1);
    EXPECT_EQ(problems(sheet({vertices, {{0, 0, 3}, {0, 1, 2}, {0, 1, 3}}})), Problems{});
}

TEST(Sheet, IsWhereItsSettingsSay)
{
    ColliderSettings settings = sheet(grid_mesh(3, 2, 1, [](auto x, auto y) { return double(x + y); }));
    settings.position = {10, 20, 30};
    settings.scale = 2;
    const auto box_is = [&](const Vector3d& lower, const Vector3d& upper) {
        const Box box = make_sheet(settings)->bounds();
        EXPECT_LE((box.lower - lower).norm() + (box.upper - upper).norm(), 1e-13);
    };
    const Vector3d half = Vector3d::Constant(0.5e-3);
    for (const ColliderShape shape : {ColliderShape::Mesh, ColliderShape::DistanceGrid}) {
        settings.shape = shape;
        settings.rotation = {0, 0, 0};
        box_is(Vector3d(10, 20, 30) - half, Vector3d(14, 22, 36) + half);
        settings.rotation = {0, 0, 90};
        box_is(Vector3d(8, 20, 30) - half, Vector3d(10, 24, 36) + half);
    }
    settings.shape = ColliderShape::Heightfield;
    settings.spacing = 0.5;
    settings.rotation = {0, 0, 0};
    box_is(Vector3d(10, 20, 30) - half, Vector3d(11, 20.5, 36) + half);
    settings.rotation = {0, 90, 0};
    box_is(Vector3d(10, 20, 29) - half, Vector3d(16, 20.5, 30) + half);
    settings.rotation = {90, 90, 0};
    box_is(Vector3d(10, 14, 29) - half, Vector3d(10.5, 20, 30) + half);
}

} // namespace
} // namespace slod::test
