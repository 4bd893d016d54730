#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "effects/solid.hpp"
#include "support/case_rows.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

// Where the surface of each shape is. What is checked holds for any convex solid, so a new shape is checked
// by its line in one_of_each().
namespace slod::test {
namespace {

constexpr int draws = 20'000;
/// Coordinates are below 4; the solids take about ten roundings to a distance.
constexpr double rounding = 10 * 4 * 0x1p-52;

Vector3d random_place(Random& random)
{
    return 3 * random.uniform() * random_direction(random);
}

class EverySolid : public testing::TestWithParam<ColliderSettings> {
protected:
    std::unique_ptr<Solid> solid_ = make_solid(GetParam());
};

std::string name_of(const testing::TestParamInfo<ColliderSettings>& info)
{
    return info.param.name;
}

TEST_P(EverySolid, HasItsNearestPointWhereDistanceAndNormalSay)
{
    Random random(1, 0, 0);
    for (int i = 0; i < draws; ++i) {
        const Vector3d x = random_place(random);
        const Surface surface = solid_->surface(x);
        ASSERT_NEAR(surface.normal.norm(), 1, rounding);
        const Vector3d nearest = x - surface.distance * surface.normal;
        ASSERT_NEAR(solid_->surface(nearest).distance, 0, rounding) << x.transpose();
    }
}

// Both follow from its being a distance to a convex set, and make the steps from plane to plane safe.
TEST_P(EverySolid, IsWhollyBehindThePlaneAtItsNearestPoint)
{
    Random random(2, 0, 0);
    for (int i = 0; i < draws; ++i) {
        const Vector3d x = random_place(random), y = random_place(random);
        const Surface at_x = solid_->surface(x), at_y = solid_->surface(y);
        ASSERT_LE(std::abs(at_x.distance - at_y.distance), (x - y).norm() + rounding);
        if (at_x.distance > 0) {
            ASSERT_GE(at_y.distance, at_x.distance + at_x.normal.dot(y - x) - rounding);
        }
    }
}

TEST_P(EverySolid, FindsNoPointOfItsInsideNearerThanTheSurface)
{
    Random random(3, 0, 0);
    for (int i = 0; i < draws; ++i) {
        const Vector3d x = random_place(random), y = random_place(random);
        const double to_x = solid_->surface(x).distance, to_y = solid_->surface(y).distance;
        if (to_x > 0 && to_y <= 0) {
            ASSERT_GE((x - y).norm(), to_x - to_y - rounding);
        }
    }
}

TEST_P(EverySolid, IsWithinItsBounds)
{
    const Box bounds = solid_->bounds();
    Random random(4, 0, 0);
    for (int i = 0; i < draws; ++i) {
        const Vector3d x = random_place(random);
        const Surface surface = solid_->surface(x);
        const Vector3d on_it = x - surface.distance * surface.normal;
        ASSERT_TRUE((on_it.array() >= bounds.lower.array() - rounding).all() &&
                    (on_it.array() <= bounds.upper.array() + rounding).all())
            << on_it.transpose();
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EverySolid, testing::ValuesIn(one_of_each()), name_of);

void expect_surface(const ColliderSettings& collider, const Vector3d& x, double distance,
                    const Vector3d& normal)
{
    const Surface surface = make_solid(collider)->surface(x);
    EXPECT_NEAR(surface.distance, distance, rounding) << collider.name << " from " << x.transpose();
    EXPECT_LE((surface.normal - normal).norm(), rounding) << collider.name << " from " << x.transpose();
}

TEST(Solid, IsWhereItsSettingsSay)
{
    expect_surface(plane({0, 0, 1}, {0, 0, 2}), {5, 6, 4}, 3, {0, 0, 1});
    expect_surface(sphere({1, 0, 0}, 2), {1, 5, 0}, 3, {0, 1, 0});
    expect_surface(box({0, 0, 0}, {1, 2, 3}), {0.5, 0, 4}, 1, {0, 0, 1});
    expect_surface(box({0, 0, 0}, {1, 2, 3}), {4, 6, 0}, 5, {0.6, 0.8, 0});
    expect_surface(box({0, 0, 0}, {1, 2, 3}), {-0.75, 0, 0}, -0.25, {-1, 0, 0});
    // By the right hand; about x first, then z.
    const double root = std::sqrt(0.75);
    expect_surface(turned(box({0, 0, 0}, {2, 1, 1}), {0, 0, 30}), {4 * root, 2, 0}, 2, {root, 0.5, 0});
    expect_surface(turned(box({0, 0, 0}, {1, 2, 1}), {30, 0, 0}), {0, 4 * root, 2}, 2, {0, root, 0.5});
    expect_surface(turned(box({1, 0, 0}, {1, 2, 3}), {0, 0, 90}), {1, 5, 0}, 4, {0, 1, 0});
    expect_surface(turned(box({0, 0, 0}, {1, 2, 3}), {0, 90, 0}), {0, 0, -4}, 3, {0, 0, -1});
    expect_surface(turned(box({0, 0, 0}, {1, 2, 3}), {90, 0, 90}), {5, 0, 0}, 2, {1, 0, 0});
    expect_surface(turned(box({0, 0, 0}, {1, 1, 1}), {0, 0, 45}), {3, 0, 0}, 3 - std::sqrt(2.0), {1, 0, 0});
    expect_surface(capsule({0, 0, 0}, {0, 0, 2}, 0.5), {2, 0, 1}, 1.5, {1, 0, 0});
    expect_surface(capsule({0, 0, 0}, {0, 0, 2}, 0.5), {0, 0, 3}, 0.5, {0, 0, 1});
    // Upright, three wide at its base and four high: the mantle's normal is (4, 3) / 5.
    const ColliderSettings upright = cone({0, 0, 4}, {0, 0, -4}, 3);
    expect_surface(upright, {1.5 + 0.8, 0, 2 + 0.6}, 1, {0.8, 0, 0.6});
    expect_surface(upright, {0, 0, 6}, 2, {0, 0, 1});
    expect_surface(upright, {1, 1, -2}, 2, {0, 0, -1});
    expect_surface(upright, {0, 3 + 3, -4}, 5, {0, 0.6, -0.8});
    expect_surface(upright, {0, 0, 0.5}, -0.5, {0, 0, -1});
}

TEST(Solid, F18_HasANormalOfItsOwnWhereThereAreMany)
{
    expect_surface(cone({1, 2, 3}, {0, 0, -1}, 1), {1, 2, 3}, 0, {0, 0, 1});
    double off = 0;
    for (const ColliderSettings& round :
         {sphere({1, 2, 3}, 1), capsule({1, 2, 3}, {1, 1, 1}, 1), cone({1, 2, 3}, {0, 0, -2}, 0.1)}) {
        const Vector3d middle = round.position + 0.5 * round.axis;
        const std::unique_ptr<Solid> solid = make_solid(round);
        for (const Vector3d& x : {round.position, middle}) {
            const Surface once = solid->surface(x), again = solid->surface(x);
            off = std::max(off, std::abs(once.normal.norm() - 1));
            EXPECT_EQ(once.normal, again.normal) << round.name;
        }
    }
    expect_at_most("error of a normal's length", off, rounding);
}

TEST(ColliderSettings, F25_AreRefusedWhereTheyLeaveNothingSolid)
{
    for (const ColliderSettings& sound : one_of_each())
        EXPECT_EQ(problems(sound), Problems{}) << sound.name;
    int refused = 0;
    const auto says = [&](const ColliderSettings& collider, const std::string& start) {
        const Problems found = problems(collider);
        const bool does = found.size() == 1 && found.front().starts_with(start);
        refused += does ? 1 : 0;
        return does;
    };
    EXPECT_TRUE(says(plane({0, 0, 0}, {0, 0, 0}), "normal = [0, 0, 0] has no direction; use one"));
    EXPECT_TRUE(says(sphere({0, 0, 0}, 0), "radius = 0 leaves nothing solid; use"));
    EXPECT_TRUE(says(box({0, 0, 0}, {1, 0, 2}), "half_extent = [1, 0, 2] leaves nothing solid; use"));
    EXPECT_TRUE(says(cone({0, 0, 0}, {0, 0, 0}, 1), "axis = [0, 0, 0] has no direction; give"));
    EXPECT_TRUE(says(cone({0, 0, 0}, {0, 0, -1}, 0), "radius = 0"));
    EXPECT_TRUE(says(capsule({0, 0, 0}, {0, 0, 0}, 1), "axis = [0, 0, 0] has no direction; give"));
    EXPECT_TRUE(says(capsule({0, 0, 0}, {1, 0, 0}, 0), "radius = 0"));
    EXPECT_EQ(problems(cone({0, 0, 0}, {0, 0, 0}, 0)).size(), 2U);
    EXPECT_EQ(problems(turned(sphere({0, 0, 0}, 1), {0, 0, 1})).size(), 1U) << "which looks the same";
    expect_at_least("degenerate solids refused, of 7", refused, 7);
}

// The squares of what the settings may hold neither vanish nor leave the range of numbers.
TEST(ColliderSettings, F25_MayBeVerySmallOrVeryLarge)
{
    for (const double size : {1e-30, 1e30}) {
        for (const ColliderSettings& collider :
             {plane({0, 0, 0}, {0, 0, size}), sphere({0, 0, 0}, size), box({0, 0, 0}, {size, size, size}),
              cone({0, 0, 0}, {0, 0, -size}, size), capsule({0, 0, 0}, {size, 0, 0}, size)}) {
            EXPECT_EQ(problems(collider), Problems{}) << collider.name;
            const Surface surface = make_solid(collider)->surface({0, 0, 3 * size});
            EXPECT_TRUE(std::isfinite(surface.distance) && surface.distance > 0) << collider.name;
            expect_at_most("error of a normal's length", std::abs(surface.normal.norm() - 1), rounding);
        }
    }
}

} // namespace
} // namespace slod::test
