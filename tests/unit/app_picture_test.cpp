#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "app/density_map.hpp"
#include "app/picture.hpp"
#include "app/scales.hpp"
#include "core/random.hpp"

namespace slod {
namespace {

ParticleSet blob(std::size_t count, const Vector3d& position, float mass)
{
    return ParticleSet(count, Particle{.position = position, .velocity = {0, 0, 0}, .id = 0, .mass = mass});
}

/// CIE L* of a colour, 0 to 100 (CIE 15:2004 after the sRGB transfer function of IEC 61966-2-1).
double lightness(Colour colour)
{
    const auto linear = [](std::uint8_t level) {
        const double share = level / 255.0;
        return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    const double luminance =
        0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
    return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
}

// More particles than a value needs lie in one cell, so nothing is smoothed there: 100 x 0.5 mass on a cell
// of 0.1 x 0.1. Products of the cell's width round to some ulp: 1e-12 relative is far above.
TEST(DensityMap, ABlobIsInItsCellWithItsMassPerArea)
{
    const Square square{.centre_right = 10, .centre_up = -5, .half_width = 2};
    const DensityMap map = density_map(blob(100, {10.55, 3, -4.25}, 0.5F), {.right = 0, .up = 2}, square, 40);
    const std::size_t column = 25; // (10.55 - 8) / 0.1
    const std::size_t row = 12;    // (-3 - -4.25) / 0.1
    EXPECT_NEAR(map.values[row * 40 + column], 100 * 0.5 / 0.01, 5000e-12);
    EXPECT_EQ(std::max_element(map.values.begin(), map.values.end()) - map.values.begin(),
              std::ptrdiff_t(row * 40 + column));
    EXPECT_FALSE(map.by_number);
}

TEST(DensityMap, WeightlessParticlesAreCounted)
{
    const DensityMap map = density_map(blob(100, {0.05, 0.05, 0}, 0), {}, {.half_width = 2}, 40);
    EXPECT_TRUE(map.by_number);
    EXPECT_NEAR(map.values[19 * 40 + 20], 100 / 0.01, 10000e-12);
}

// 250,000 particles of mass 1 on a square of area 4, mapped on 50 x 50 cells: a hundred in a cell, so nothing
// is smoothed and each value is a Poisson number with a standard deviation of a tenth. Six of those for 2,500
// cells.
TEST(DensityMap, AnEvenSheetHasItsDensityEverywhere)
{
    ParticleSet sheet;
    for (std::uint64_t i = 0; i < 250'000; ++i) {
        Random random(1, 0, i);
        const double x = 2 * random.uniform() - 1;
        sheet.push_back(
            {.position = {x, 2 * random.uniform() - 1, 0}, .velocity = {0, 0, 0}, .id = i, .mass = 1});
    }
    const DensityMap map = density_map(sheet, {}, {.half_width = 1}, 50);
    for (const double value : map.values)
        EXPECT_NEAR(value, 250'000 / 4.0, 0.6 * 250'000 / 4.0);
}

TEST(DensityMap, OneStrayDoesNotShrinkThePicture)
{
    ParticleSet particles = blob(500, {-1, 0, 0}, 1);
    const ParticleSet right = blob(500, {1, 0, 0}, 1);
    particles.insert(particles.end(), right.begin(), right.end());
    particles.push_back(blob(1, {1e9, -1e9, 0}, 1).front());
    const Square square = square_around(particles, {});
    EXPECT_EQ(square.centre_right, 0);
    EXPECT_EQ(square.centre_up, 0);
    EXPECT_GT(square.half_width, 1);
    EXPECT_LT(square.half_width, 1.5);
}

// Two blobs across a diagonal. The scale ends at the denser one and is a decade long, the least there is, so
// a quarter of the density is at 1 - log10(4) of it, where L* is 2 + 95 times that; colours of whole levels
// are within 1 of their L*.
TEST(Picture, ABlobLandsOnItsPixel)
{
    ParticleSet particles = blob(4000, {-1, -1, 0}, 1);
    const ParticleSet other = blob(1000, {1, 1, 0}, 1);
    particles.insert(particles.end(), other.begin(), other.end());
    const Canvas canvas = draw_picture(particles, {}, {.scene = "two blobs", .units = {}});

    const Square square = square_around(particles, {});
    const auto cells = [&](double length) {
        return int(length / (2 * square.half_width) * PictureLayout::map_side);
    };
    const auto pixel = [&](double x, double y) {
        return canvas.pixel(PictureLayout::map_left + cells(x + square.half_width),
                            PictureLayout::map_top + cells(square.half_width - y));
    };
    const double brightest = lightness(colour_of(1));
    EXPECT_EQ(lightness(pixel(-1, -1)), brightest);
    EXPECT_NEAR(lightness(pixel(1, 1)), 2 + 95 * (1 - std::log10(4)), 1);
    EXPECT_LT(lightness(pixel(0, 0)), 10);
    EXPECT_LT(lightness(pixel(-1, 1)), 10);
}

TEST(Picture, NoParticlesMakeAnEmptyPicture)
{
    const std::string png = draw_picture({}, {}, {.scene = "nothing", .units = {}}).png();
    EXPECT_EQ(png.substr(1, 3), "PNG");
}

TEST(Picture, WhatFallsIsSeenUpright)
{
    SimulationSettings settings;
    EXPECT_EQ(viewing_plane(settings).up, 1);
    settings.uniform_gravity = UniformGravitySettings{.acceleration = {0, 0, -9.81}};
    EXPECT_EQ(viewing_plane(settings).up, 2);
    settings.uniform_gravity = UniformGravitySettings{.acceleration = {0, -9.81, 0}};
    EXPECT_EQ(viewing_plane(settings).up, 1);
}

// 95 of L* in 64 steps are 1.48 each. The table's entries are whole levels of sRGB, worth up to 0.5 of L* in
// the dark, and lightness is not linear between two entries: 0.9 for both.
TEST(ColourMap, LightnessRisesEvenly)
{
    for (int step = 1; step <= 64; ++step) {
        const double rise = lightness(colour_of(step / 64.0)) - lightness(colour_of((step - 1) / 64.0));
        EXPECT_NEAR(rise, 95.0 / 64, 0.9) << "step " << step;
    }
}

TEST(ColourMap, WhatIsOffTheScaleHasTheColourOfItsEnd)
{
    EXPECT_EQ(lightness(colour_of(-1)), lightness(colour_of(0)));
    EXPECT_EQ(lightness(colour_of(std::nan(""))), lightness(colour_of(0)));
    EXPECT_EQ(lightness(colour_of(7)), lightness(colour_of(1)));
}

TEST(Scales, TicksAreRoundAndNotTooMany)
{
    EXPECT_EQ(round_numbers(-1, 1, 4), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(round_numbers(0, 90, 9), (std::vector<double>{0, 10, 20, 30, 40, 50, 60, 70, 80, 90}));
    EXPECT_EQ(round_numbers(0, 9, 5), (std::vector<double>{0, 2, 4, 6, 8}));
    EXPECT_EQ(round_numbers(-172, 172, 9), (std::vector<double>{-150, -100, -50, 0, 50, 100, 150}));
    EXPECT_FALSE(std::signbit(round_numbers(-0.3, 90, 9).front())) << "the label would be -0";
}

TEST(Scales, UnitsHaveTheirNames)
{
    EXPECT_EQ(length_unit({.length_m = 3.0857e19}), "kpc");
    EXPECT_EQ(length_unit({.length_m = 1}), "m");
    EXPECT_EQ(length_unit({.length_m = 4.2e7}), "4.2e+07 m");
    EXPECT_EQ(mass_unit({.mass_kg = 1.989e40}), "1e10 Msun");
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(5400), "1.5 h");
    EXPECT_EQ(duration_text(3.15576e15), "100 Myr");
}

} // namespace
} // namespace slod
