#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/falling_particle.hpp"
#include "support/meshes.hpp"
#include "support/solids.hpp"

// Vertices that many triangles share, and particles that meet them exactly.
namespace slod::test {
namespace {

constexpr double thickness = 1e-2;

struct Fan {
    std::uint32_t triangles;
    double depth; ///< of the hub below the rim, which is at a distance of 1 from its axis
};

std::string name_of(const testing::TestParamInfo<Fan>& info)
{
    const double depth = info.param.depth;
    return std::to_string(info.param.triangles) +
           (depth == 0  ? "Flat"
            : depth > 0 ? "Hollow"
                        : "Peaked") +
           std::to_string(std::lround(1000 * std::abs(depth)));
}

/// About a hub at the origin.
Mesh fan_mesh(const Fan& fan)
{
    Mesh mesh;
    mesh.vertices.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < fan.triangles; ++i) {
        const double turn = 2 * M_PI * i / fan.triangles;
        mesh.vertices.push_back({std::cos(turn), std::sin(turn), fan.depth});
        mesh.triangles.push_back({0, i + 1, (i + 1) % fan.triangles + 1});
    }
    return mesh;
}

class FanOfManyTriangles : public testing::TestWithParam<Fan> {
protected:
    Colliders with_surface(double restitution, double friction) const
    {
        return {{with(sheet(fan_mesh(GetParam()), thickness), restitution, friction)}, falling(), frame};
    }
};

// Its speeds after impacts are 0.4, 0.16 and so on of the first, until it lies. Energies below 3 are rounded
// by 4e-16 some tens of times in a frame.
TEST_P(FanOfManyTriangles, LetsWhatFallsOnItsHubBounceAndComeToRest)
{
    const Colliders colliders = with_surface(0.4, 0.5);
    Vector3d position(0, 0, 0.3), velocity(0, 0, 0);
    std::uint32_t impacts = 0;
    double fastest_up = 0;
    for (int i = 0; i < 1200; ++i) {
        const double before = 0.5 * velocity.squaredNorm() + fall * position.z();
        const auto met = colliders.fly(position, velocity, frame);
        ASSERT_FALSE(met.cut_off) << "frame " << i;
        ASSERT_LE(0.5 * velocity.squaredNorm() + fall * position.z(), before + 1e-14) << "frame " << i;
        impacts += met.impacts;
        fastest_up = std::max(fastest_up, velocity.z());
    }
    EXPECT_GE(impacts, 2U);
    EXPECT_GT(fastest_up, 0.1);
    EXPECT_LE(velocity.norm(), 1e-6);
    EXPECT_GE(position.z(), 0.5 * thickness - 1e-12) << "it is above the sheet";
}

INSTANTIATE_TEST_SUITE_P(Fans, FanOfManyTriangles,
                         testing::Values(Fan{24, 0}, Fan{100, 0}, Fan{250, 0}, Fan{24, 0.2}, Fan{100, 0.2},
                                         Fan{100, 1e-3}, Fan{24, -0.2}, Fan{100, -0.2}),
                         name_of);

// Over the hub, and past it within rounding of it, without friction: as on a plane.
TEST(FlatFanOfManyTriangles, LetsWhatSlidesOverItsHubPass)
{
    for (const std::uint32_t triangles : {24U, 100U}) {
        const Colliders colliders({with(sheet(fan_mesh({triangles, 0}), thickness), 0.3, 0)}, falling(),
                                  frame);
        for (const double off : {0.0, 1e-16, 1e-14, 1e-3}) {
            Vector3d position(-0.5, off, 0.5 * thickness), velocity(1, 0, 0);
            for (int i = 0; i < 60; ++i)
                ASSERT_FALSE(colliders.fly(position, velocity, frame).cut_off) << triangles << ", " << off;
            // Sixty frames, each of some ten roundings of 1.
            EXPECT_LE((position - Vector3d(0.5, off, 0.5 * thickness)).norm(), 1e-13) << triangles;
            EXPECT_LE((velocity - Vector3d(1, 0, 0)).norm(), 1e-13) << triangles;
        }
    }
}

} // namespace
} // namespace slod::test
