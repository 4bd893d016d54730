#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "effects/emitter.hpp"
#include "support/newborns.hpp"

// Where the particles of each shape start, and those of an emitter that moves.
namespace slod {
namespace {

constexpr int count = 100'000;
constexpr double step = 1;

EmitterSettings emitter_with(EmitterShape shape)
{
    EmitterSettings settings;
    settings.shape = shape;
    settings.position = {1, -2, 3};
    settings.direction = {2, -1, 2};
    settings.speed = 0;
    settings.rate = 0;
    settings.burst = count;
    return settings;
}

/// Offsets from the emitter of a burst's particles, which do not move.
std::vector<Vector3d> offsets_of(const EmitterSettings& settings)
{
    std::vector<Newborn> all;
    test::add_newborns(Emitter(settings, 2, 0, 99), 1, step, {}, all);
    std::vector<Vector3d> offsets;
    for (const Newborn& born : all)
        offsets.push_back(born.particle.position - settings.position);
    return offsets;
}

/// Mean and covariance of points, which are independent.
struct Sample {
    explicit Sample(const std::vector<Vector3d>& points)
    {
        for (const Vector3d& x : points) {
            mean += x / double(points.size());
            second += x * x.transpose() / double(points.size());
        }
    }

    Vector3d mean{0, 0, 0};
    Matrix3d second = Matrix3d::Zero();
};

/// Whether the mean is 0 and the second moments are `second`, within five standard errors. No coordinate is
/// beyond `reach`, so a mean's is at most reach / sqrt(count), and that of a second moment reach^2 /
/// sqrt(count).
void expect_distribution(const std::vector<Vector3d>& points, const Matrix3d& second, double reach)
{
    ASSERT_EQ(points.size(), std::size_t(count));
    const Sample sample(points);
    const double five_sigma = 5 / std::sqrt(double(count));
    EXPECT_LE(sample.mean.cwiseAbs().maxCoeff(), five_sigma * reach);
    EXPECT_LE((sample.second - second).cwiseAbs().maxCoeff(), five_sigma * reach * reach)
        << sample.second << "\ninstead of\n"
        << second;
}

/// The share of points that satisfy `inside` is `share`, within five standard errors of a binomial number.
template <class Inside>
void expect_share(const std::vector<Vector3d>& points, double share, const Inside& inside)
{
    const auto there = std::count_if(points.begin(), points.end(), inside);
    EXPECT_NEAR(double(there) / count, share, 5 * std::sqrt(share * (1 - share) / count));
}

const Vector3d normal = Vector3d(2, -1, 2) / 3;

/// Projects onto the plane across the direction.
Matrix3d across()
{
    return Matrix3d::Identity() - normal * normal.transpose();
}

TEST(EmitterShape, APointIsOne)
{
    for (const Vector3d& x : offsets_of(emitter_with(EmitterShape::Point)))
        ASSERT_EQ(x, Vector3d(0, 0, 0));
}

// Of a circle the mean square of either coordinate is r^2 / 2.
TEST(EmitterShape, ARingIsEvenAllRoundAcrossTheDirection)
{
    EmitterSettings settings = emitter_with(EmitterShape::Ring);
    settings.radius = 2;
    const auto points = offsets_of(settings);
    expect_distribution(points, 4.0 / 2 * across(), 2);
    for (const Vector3d& x : points) {
        ASSERT_NEAR(x.norm(), 2, 1e-14);
        ASSERT_NEAR(x.dot(normal), 0, 1e-14);
    }
}

// Of an annulus from a to r the mean square radius is (r^2 + a^2) / 2; half of the area is within the root of
// that.
TEST(EmitterShape, ADiscIsEvenOverItsAreaAndEmptyInItsHole)
{
    for (const double hole : {0.0, 1.5}) {
        EmitterSettings settings = emitter_with(EmitterShape::Disc);
        settings.radius = 2;
        settings.inner_radius = hole;
        const auto points = offsets_of(settings);
        const double mean_square = (4 + hole * hole) / 2;
        expect_distribution(points, mean_square / 2 * across(), 2);
        expect_share(points, 0.5, [&](const Vector3d& x) { return x.squaredNorm() < mean_square; });
        for (const Vector3d& x : points) {
            ASSERT_NEAR(x.dot(normal), 0, 1e-14);
            ASSERT_GE(x.norm(), hole - 1e-14);
            ASSERT_LE(x.norm(), 2 + 1e-14);
        }
    }
}

// Of a shell from a to r the mean square radius is 3/5 (r^5 - a^5) / (r^3 - a^3), a third of it along any
// axis.
TEST(EmitterShape, ASphereIsEvenOverItsVolumeAndHollowWithin)
{
    for (const double hollow : {0.0, 1.5}) {
        EmitterSettings settings = emitter_with(EmitterShape::Sphere);
        settings.radius = 2;
        settings.inner_radius = hollow;
        const auto points = offsets_of(settings);
        const double volume = 8 - std::pow(hollow, 3);
        const double mean_square = 0.6 * (32 - std::pow(hollow, 5)) / volume;
        expect_distribution(points, mean_square / 3 * Matrix3d::Identity(), 2);
        expect_share(points, (std::pow(1.8, 3) - std::pow(hollow, 3)) / volume,
                     [](const Vector3d& x) { return x.norm() < 1.8; });
        for (const Vector3d& x : points) {
            ASSERT_GE(x.norm(), hollow - 1e-14);
            ASSERT_LE(x.norm(), 2 + 1e-14);
        }
    }
}

TEST(EmitterShape, ASpheresSurfaceIsEven)
{
    EmitterSettings settings = emitter_with(EmitterShape::Sphere);
    settings.radius = 2;
    settings.fill = Fill::Surface;
    const auto points = offsets_of(settings);
    expect_distribution(points, 4.0 / 3 * Matrix3d::Identity(), 2);
    expect_share(points, 0.25, [](const Vector3d& x) { return x.z() > 1; }); // a cap of the height r / 2
    for (const Vector3d& x : points)
        ASSERT_NEAR(x.norm(), 2, 1e-14);
}

// The mean square of a number that is uniform in [-h, h] is h^2 / 3.
TEST(EmitterShape, ABoxIsEvenOverItsVolumeAlongTheAxes)
{
    EmitterSettings settings = emitter_with(EmitterShape::Box);
    settings.half_extent = {2, 1, 0};
    const auto points = offsets_of(settings);
    expect_distribution(points, Vector3d(4.0 / 3, 1.0 / 3, 0).asDiagonal(), 2);
    for (const Vector3d& x : points)
        ASSERT_TRUE((x.cwiseAbs().array() <= settings.half_extent.array()).all());
}

// Faces of 4 b c across a, and so on: a share of area is on x = +-a, where x^2 is a^2, and elsewhere a^2 / 3.
TEST(EmitterShape, ABoxesSurfaceIsEvenOverAllSixFaces)
{
    EmitterSettings settings = emitter_with(EmitterShape::Box);
    settings.half_extent = {2, 1, 0.5};
    settings.fill = Fill::Surface;
    const auto points = offsets_of(settings);
    const Vector3d areas(0.5, 1, 2);
    Vector3d second;
    for (int axis = 0; axis < 3; ++axis) {
        const double share = areas[axis] / areas.sum();
        second[axis] = std::pow(settings.half_extent[axis], 2) * (share + (1 - share) / 3);
        expect_share(points, share / 2,
                     [&](const Vector3d& x) { return x[axis] == settings.half_extent[axis]; });
    }
    expect_distribution(points, second.asDiagonal(), 2);
    for (const Vector3d& x : points)
        ASSERT_TRUE((x.cwiseAbs().array() == settings.half_extent.array()).any());
}

TEST(EmitterShape, ChangesNoVelocity)
{
    EmitterSettings settings = emitter_with(EmitterShape::Point);
    settings.speed = 3;
    settings.cone_angle_deg = 50;
    std::vector<Newborn> from_point, from_sphere;
    test::add_newborns(Emitter(settings, 2, 0, 99), 1, step, {}, from_point);
    settings.shape = EmitterShape::Sphere;
    settings.radius = 1;
    test::add_newborns(Emitter(settings, 2, 0, 99), 1, step, {}, from_sphere);
    for (std::size_t i = 0; i < from_point.size(); ++i)
        ASSERT_EQ(from_point[i].particle.velocity, from_sphere[i].particle.velocity);
}

// A particle without a speed of its own is born where the emitter is at that time, and then goes on at the
// share of its velocity that it has got.
TEST(Emitter, ThatMovesHandsOnItsShareOfItsVelocity)
{
    for (const double share : {0.0, 0.25, 1.0}) {
        EmitterSettings settings;
        settings.position = {1, -2, 3};
        settings.velocity = {0.5, 2, -4};
        settings.inherit = share;
        settings.speed = 0;
        settings.rate = 77;
        settings.start = 0.4;
        const Emitter emitter(settings, 0, 0, 99);
        for (const double length : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
            std::vector<Newborn> all;
            for (std::uint64_t frame = 1; double(frame) * length <= 2; ++frame)
                test::add_newborns(emitter, frame, length, {}, all);
            ASSERT_NEAR(double(all.size()), 1.6 * 77, 2);
            double frame_end = 0;
            for (std::size_t k = 0; k < all.size(); ++k) {
                const double start = 0.4 + double(k) / 77;
                frame_end = std::round((start + all[k].age) / length) * length;
                ASSERT_NEAR(start + all[k].age, frame_end, 1e-13) << "born at another time";
                const Vector3d place = settings.position + start * settings.velocity;
                const Vector3d velocity = share * settings.velocity;
                ASSERT_EQ(all[k].particle.velocity, velocity);
                // Coordinates below 16, each rounded a few times.
                ASSERT_LE((all[k].particle.position - place - all[k].age * velocity).norm(),
                          16 * 8 * 0x1p-53);
            }
        }
    }
}

} // namespace
} // namespace slod
