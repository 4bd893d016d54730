#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "viewer/offscreen.hpp"
#include "viewer/picture_file.hpp"
#include "viewer/splat_renderer.hpp"

// OpenGL without a screen, in software where there is no graphics card.
namespace slod::viewer {
namespace {

constexpr view::Viewport picture{.width = 200, .height = 120};
constexpr std::uint32_t white = 0xffffffff;

class ViewerDrawing : public testing::Test {
protected:
    Pixels drawn(SplatRenderer& renderer, view::Splats splats, bool finest = true) const
    {
        const Target target(picture.width, picture.height, GL_RGBA8);
        renderer.draw(splats, picture, 1, finest, target.framebuffer());
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
        return read_pixels(picture);
    }

    /// Red of a pixel; y from the top.
    static int red(const Pixels& pixels, int x, int y)
    {
        return pixels.bytes[4 * std::size_t((picture.height - 1 - y) * picture.width + x)];
    }

    static int largest_difference(const Pixels& left, const Pixels& right)
    {
        int largest = 0;
        for (std::size_t i = 0; i < left.bytes.size(); ++i)
            largest = std::max(largest, std::abs(int(left.bytes[i]) - int(right.bytes[i])));
        return largest;
    }

    const OffscreenContext context;
};

/// A disc of a radius in pixels.
view::EllipseSplat disc(float x, float y, float radius, float light)
{
    const float steepness = 1 / (radius * radius);
    return {x, y, radius, radius, steepness, 0, steepness, light, white};
}

TEST_F(ViewerDrawing, NothingIsBlack)
{
    SplatRenderer renderer;
    const Pixels pixels = drawn(renderer, {});
    EXPECT_EQ(*std::max_element(pixels.bytes.begin(), pixels.bytes.end()), 255) << "opaque";
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            ASSERT_EQ(red(pixels, x, y), 0);
}

TEST_F(ViewerDrawing, AnEllipseIsWhereItShouldBeAndFadesOutwards)
{
    view::Splats splats;
    splats.ellipses.push_back(disc(50, 30, 20, 1));
    splats.typical_light = 1;
    SplatRenderer renderer;
    const Pixels pixels = drawn(renderer, splats);
    EXPECT_GT(red(pixels, 50, 30), red(pixels, 62, 30));
    EXPECT_GT(red(pixels, 62, 30), 0);
    EXPECT_EQ(red(pixels, 71, 30), 0);
    EXPECT_EQ(red(pixels, 50, 30 + 21), 0);
    EXPECT_EQ(red(pixels, 50, picture.height - 30), 0) << "not upside down";
}

// The same sums in another order: where they are rounded differently a step of 255 may be.
TEST_F(ViewerDrawing, PointsSummedUpByHandAreThoseThatOpenGLDraws)
{
    std::mt19937 bits(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    view::Splats splats;
    for (int i = 0; i < 500; ++i)
        splats.points.push_back({std::floor(uniform(bits) * 200) + 0.25F,
                                 std::floor(uniform(bits) * 120) + 0.25F, uniform(bits),
                                 0xff000000 | std::uint32_t(bits() & 0xffffff)});
    splats.typical_light = 1;
    SplatRenderer by_hand(true), by_opengl(false);
    EXPECT_LE(largest_difference(drawn(by_hand, splats), drawn(by_opengl, splats)), 1);
}

// Light is interpolated between pixels 2 apart. (1 - u)^2 bends by less than 8 / 35^2 of its peak, so it is
// off by less than (2/35)^2, which in the middle half of the disc is a quarter of a step of 255; each picture
// rounds once.
TEST_F(ViewerDrawing, ACoarseEllipseLooksLikeAFineOne)
{
    view::Splats splats;
    for (int i = 0; i < 1000; ++i) // enough to be beyond the budget
        splats.ellipses.push_back(disc(100, 40, 35, 0.001F));
    splats.typical_light = 1;
    SplatRenderer renderer(true);
    const Pixels fine = drawn(renderer, splats), coarse = drawn(renderer, splats, false);
    EXPECT_GT(largest_difference(fine, coarse), 0);
    EXPECT_NEAR(red(fine, 100, 40), red(coarse, 100, 40), 1);
    EXPECT_NEAR(red(fine, 115, 40), red(coarse, 115, 40), 1);
    EXPECT_EQ(red(coarse, 100 + 60, 40), 0);
}

TEST_F(ViewerDrawing, LightBeyondAllBoundsIsWhite)
{
    view::Splats splats;
    splats.ellipses.assign(2, disc(100, 60, 50, 3e38F)); // together more than a float holds
    splats.typical_light = 1;
    for (const bool in_software : {true, false}) {
        SplatRenderer renderer(in_software);
        EXPECT_EQ(red(drawn(renderer, splats), 100, 60), 255);
    }
}

TEST_F(ViewerDrawing, AFileThatCannotBeWrittenIsNamed)
{
    SplatRenderer renderer;
    try {
        write_png(drawn(renderer, {}), "/nowhere/picture.png");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("/nowhere/picture.png"), std::string::npos);
    }
}

} // namespace
} // namespace slod::viewer
