#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "effects/emitter.hpp"
#include "support/case_rows.hpp"
#include "support/newborns.hpp"

namespace slod {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double step = 0.02;

EmitterSettings jet()
{
    return {.name = "jet",
            .kind = "water",
            .position = {1, 2, 3},
            .direction = {1, 1, 4},
            .speed = 5,
            .speed_spread = 0.2,
            .cone_angle_deg = 25,
            .rate = 333};
}

Emitter emitter_of(const EmitterSettings& settings)
{
    return Emitter(settings, 2, 1, 99);
}

/// Frames [1, frames], each newborn as it is at its frame's end.
std::vector<Newborn> emit(const Emitter& emitter, std::uint64_t frames, double frame_length = step,
                          const UniformFields& fields = {})
{
    std::vector<Newborn> all;
    for (std::uint64_t frame = 1; frame <= frames; ++frame)
        test::add_newborns(emitter, frame, frame_length, fields, all);
    return all;
}

TEST(Emitter, F33_AFractionalRateIsMetToOneParticleAtEveryTime)
{
    for (const double per_frame : {0.3, 0.001, 1.0, 7.7, 1234.5}) {
        EmitterSettings settings = jet();
        settings.rate = per_frame / step;
        const Emitter emitter = emitter_of(settings);
        std::vector<Newborn> all;
        for (std::uint64_t frame = 1; frame <= 200; ++frame) {
            test::add_newborns(emitter, frame, step, {}, all);
            test::expect_at_most("particles too many or too few",
                                 std::abs(double(all.size()) - per_frame * double(frame)), 1);
            ASSERT_EQ(all.size(), emitter.count_before(double(frame) * step));
        }
    }
}

TEST(Emitter, TheFirstParticleStartsAtTheStartAndTheLastBeforeTheStop)
{
    EmitterSettings settings = jet();
    settings.rate = 10;
    settings.start = 1;
    settings.stop = 2;
    const Emitter emitter = emitter_of(settings);
    EXPECT_EQ(emitter.count_before(0.5), 0U);
    EXPECT_EQ(emitter.count_before(1), 0U);
    EXPECT_EQ(emitter.count_before(1.01), 1U);
    EXPECT_EQ(emitter.count_before(1.1001), 2U);
    EXPECT_EQ(emitter.count_before(2), 10U);
    EXPECT_EQ(emitter.count_before(1e9), 10U);
    settings.stop = 0.5;
    EXPECT_EQ(emitter_of(settings).count_before(10), 0U);
}

// Times are then known to their last place only, 2^-29 of a unit here, which is all that a start can be off
// by; a rounding more comes from its division by the rate, and one from the difference.
TEST(Emitter, N15_AfterABillionFramesParticlesStartAndDieOnTime)
{
    constexpr std::uint64_t start = 1'000'000'000;
    constexpr double length = 1.0 / 60, last_place = 0x1p-29;
    EmitterSettings settings = jet();
    settings.lifetime = 10 * length;
    const Emitter emitter = emitter_of(settings);
    ASSERT_EQ(std::nextafter(double(start) * length, infinity) - double(start) * length, last_place);
    std::uint64_t next = emitter.count_before(double(start) * length);
    double worst = 0, worst_death = 0;
    for (std::uint64_t frame = start + 1; frame <= start + 600; ++frame) {
        std::vector<Newborn> all;
        test::add_newborns(emitter, frame, length, {}, all);
        for (const Newborn& born : all) {
            ASSERT_EQ(born.particle.id, (3ULL << Emitter::id_shift) + next);
            const long double birth = static_cast<long double>(next++) / settings.rate;
            const long double end = static_cast<long double>(frame) * length;
            worst = std::max(worst, std::abs(double(end - birth) - born.age));
            const double death = double(birth / length) + 10 - double(frame);
            worst_death =
                std::max(worst_death, std::abs(double(born.particle.expiry_frame - frame) - death - 0.5));
        }
    }
    test::expect_within("started in 600 frames", double(next - emitter.count_before(double(start) * length)),
                        3329, 3331);
    test::expect_at_most("error of a newborn's age", worst, 3 * last_place);
    // Frames of death are the next whole ones.
    test::expect_at_most("distance of the frame of death from the middle of its frame", worst_death,
                         0.5 + 60 * 3 * last_place);
}

TEST(Emitter, F34_WithoutARateNothingIsEmitted)
{
    EmitterSettings settings = jet();
    settings.rate = 0;
    test::expect_at_most("particles", double(emit(emitter_of(settings), 100).size()), 0);
}

TEST(Emitter, N16_IdsAreUniqueToTheEmitterAndInOrderOfBirth)
{
    const std::vector<Newborn> all = emit(emitter_of(jet()), 100);
    for (std::size_t k = 0; k < all.size(); ++k)
        ASSERT_EQ(all[k].particle.id, (3ULL << Emitter::id_shift) + k);
    test::expect_at_least("ids in order", double(all.size()), 600);
}

// A rate at which the 2^32nd particle starts in frame 50,000: no id comes again on either side of it.
TEST(Emitter, N16_IdsGoOnBeyondTwoToTheThirtySecond)
{
    constexpr std::uint64_t frame = 50'000, wrap = std::uint64_t{1} << 32;
    EmitterSettings settings = jet();
    settings.rate = double(wrap) / ((double(frame) - 0.5) * step);
    const Emitter emitter = emitter_of(settings);
    std::vector<Newborn> all;
    test::add_newborns(emitter, frame, step, {}, all);
    ASSERT_FALSE(all.empty());
    const std::uint64_t first = 3ULL << Emitter::id_shift;
    EXPECT_LT(all.front().particle.id - first, wrap);
    test::expect_at_least("largest number of a particle", double(all.back().particle.id - first),
                          double(wrap));
    std::size_t broken = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        broken += all[i].particle.id == all[i - 1].particle.id + 1 ? 0 : 1;
    test::expect_at_most("ids out of order", double(broken), 0);
}

TEST(Emitter, ParticlesHaveTheSettingsMassAndKind)
{
    EmitterSettings settings = jet();
    settings.particle_mass = 0.25;
    for (const Newborn& born : emit(emitter_of(settings), 10)) {
        EXPECT_EQ(born.particle.mass, 0.25F);
        EXPECT_EQ(born.particle.kind, 1);
        EXPECT_EQ(born.particle.expiry_frame, Particle::never);
    }
}

// Without a field a particle keeps its velocity, and is back at the emitter its age before the frame's end.
TEST(Emitter, N17_ParticlesAreTheSameWhateverTheFrameLength)
{
    std::size_t compared = 0, others = 0;
    const Emitter emitter = emitter_of(jet());
    std::map<std::uint64_t, Particle> expected;
    for (const Newborn& born : emit(emitter, 300))
        expected[born.particle.id] = born.particle;
    for (const double length : {step / 7, step * 3, step * 100}) {
        const std::vector<Newborn> all =
            emit(emitter, std::uint64_t(std::lround(300 * step / length)), length);
        ASSERT_NEAR(double(all.size()), double(expected.size()), 1);
        for (const Newborn& born : all) {
            if (!expected.contains(born.particle.id))
                continue;
            ++compared;
            others += born.particle.velocity == expected[born.particle.id].velocity ? 0 : 1;
            const Vector3d origin = born.particle.position - born.age * born.particle.velocity;
            ASSERT_LE((origin - Vector3d(1, 2, 3)).norm(), 1e-14);
        }
    }
    test::expect_at_least("particles compared", double(compared), 5000);
    test::expect_at_most("particles with another velocity", double(others), 0);
}

TEST(Emitter, AgesAreTheTimesSinceTheEvenlySpacedStarts)
{
    for (const auto& born : emit(emitter_of(jet()), 50)) {
        const std::uint64_t k = born.particle.id & ((1ULL << Emitter::id_shift) - 1);
        const double start = double(k) / 333;
        const double end = std::ceil(start / step + 1e-9) * step;
        EXPECT_NEAR(born.age, k == 0 ? step : end - start, 1e-13) << k;
        EXPECT_LE(born.age, step * (1 + 1e-12));
        EXPECT_GE(born.age, 0);
    }
}

TEST(Emitter, NewbornsFollowTheFieldsFromTheirStartToTheFramesEnd)
{
    UniformFields fields;
    fields.gravity = {0, 0, -9.81};
    fields.drag = 0.7;
    fields.wind = {2, 0, 0};
    const std::vector<Newborn> free = emit(emitter_of(jet()), 20);
    const std::vector<Newborn> blown = emit(emitter_of(jet()), 20, step, fields);
    ASSERT_EQ(free.size(), blown.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
        const double t = free[i].age, k = 0.7;
        const double decay = std::exp(-k * t), drift = (1 - decay) / k;
        const Vector3d v0 = free[i].particle.velocity, terminal = fields.wind + fields.gravity / k;
        const Vector3d v = terminal + decay * (v0 - terminal);
        const Vector3d x = Vector3d(1, 2, 3) + t * terminal + drift * (v0 - terminal);
        ASSERT_LE((blown[i].particle.velocity - v).norm(), 1e-13);
        ASSERT_LE((blown[i].particle.position - x).norm(), 1e-14 / k * 10);
    }
}

// Uniform on a cone's cap: the cosine to the axis is uniform in [cos angle, 1], the sine has no direction.
TEST(Emitter, DirectionsAreUniformInTheCone)
{
    for (const double angle : {10.0, 90.0, 180.0}) {
        EmitterSettings settings = jet();
        settings.cone_angle_deg = angle;
        settings.speed_spread = 0;
        settings.rate = 1e6;
        const std::vector<Newborn> all = emit(emitter_of(settings), 5); // 100,000
        const Vector3d axis = Vector3d(1, 1, 4).normalized();
        const double lowest = std::cos(angle * std::numbers::pi / 180);
        double mean = 0, square = 0;
        Vector3d across{0, 0, 0};
        for (const Newborn& born : all) {
            ASSERT_NEAR(born.particle.velocity.norm(), 5, 1e-14);
            const double cosine = born.particle.velocity.dot(axis) / 5;
            ASSERT_GE(cosine, lowest - 1e-15);
            mean += cosine / double(all.size());
            square += cosine * cosine / double(all.size());
            across += (born.particle.velocity / 5 - cosine * axis) / double(all.size());
        }
        const double width = 1 - lowest;
        const double sigma = 5 / std::sqrt(double(all.size())); // five standard errors of unit variance
        EXPECT_NEAR(mean, (1 + lowest) / 2, sigma * width / std::sqrt(12.0)) << angle;
        EXPECT_NEAR(square - mean * mean, width * width / 12, sigma * width * width / 12) << angle;
        EXPECT_LE(across.norm(), sigma) << angle;
    }
}

TEST(Emitter, SpeedsAreUniformWithinTheSpread)
{
    EmitterSettings settings = jet();
    settings.rate = 1e6;
    const std::vector<Newborn> all = emit(emitter_of(settings), 5);
    double mean = 0, square = 0;
    for (const Newborn& born : all) {
        const double speed = born.particle.velocity.norm();
        ASSERT_GE(speed, 4 - 1e-14);
        ASSERT_LE(speed, 6 + 1e-14);
        mean += speed / double(all.size());
        square += (speed - 5) * (speed - 5) / double(all.size());
    }
    const double sigma = 5 / std::sqrt(double(all.size()));
    EXPECT_NEAR(mean, 5, sigma * 2 / std::sqrt(12.0));
    EXPECT_NEAR(square, 4.0 / 12, sigma * std::sqrt(4.0 / 45)); // of a square of a uniform number in [-1, 1]
}

TEST(Emitter, OnlyTheDirectionOfTheDirectionCounts)
{
    EmitterSettings settings = jet();
    settings.cone_angle_deg = 0;
    settings.speed_spread = 0;
    for (const double length : {1e-200, 1e-9, 1.0, 1e9, 1e200}) {
        settings.direction = length * Vector3d(0, 3, 4);
        const Newborn first = emit(emitter_of(settings), 1).front();
        EXPECT_LE((first.particle.velocity - Vector3d(0, 3, 4)).norm(), 1e-14) << length;
    }
}

TEST(Emitter, F34_AParticleIsThereAtTheFramesEndsWithinItsLifetime)
{
    for (const double lifetime : {0.0, 0.001, step / 2, step, 3.3 * step, 1000.0, infinity}) {
        EmitterSettings settings = jet();
        settings.lifetime = lifetime;
        settings.start = 0.0137;
        std::size_t started = 0;
        for (std::uint64_t frame = 1; frame <= 50; ++frame) {
            std::vector<Newborn> all;
            test::add_newborns(emitter_of(settings), frame, step, {}, all);
            started += all.size();
            for (const Newborn& born : all) {
                const double death = double(frame) * step - born.age + lifetime;
                ASSERT_GT(born.particle.expiry_frame, frame) << "born dead";
                if (lifetime == infinity) {
                    ASSERT_EQ(born.particle.expiry_frame, Particle::never);
                    continue;
                }
                // The last frame's end that it lives to see is the one before it expires.
                const double last = double(born.particle.expiry_frame) * step;
                test::expect_within("frames from death to expiry", (last - death) / step, -1e-7, 1 + 1e-7);
            }
        }
        EXPECT_EQ(started == 0, lifetime == 0) << lifetime;
    }
}

TEST(Emitter, N17_SeedsAndPlacesInTheSceneGiveDifferentParticles)
{
    const auto first = [](std::uint32_t index, std::uint64_t seed) {
        return emit(Emitter(jet(), index, 1, seed), 1).front().particle;
    };
    EXPECT_EQ(first(2, 99).velocity, first(2, 99).velocity);
    const Vector3d velocity = first(2, 99).velocity;
    test::expect_at_least(
        "least difference of velocities",
        std::min((velocity - first(3, 99).velocity).norm(), (velocity - first(2, 98).velocity).norm()),
        1e-9); // 1e-9 of the speed: alike by chance once in 1e18
    EXPECT_NE(first(2, 99).id, first(3, 99).id);
}

} // namespace
} // namespace slod
