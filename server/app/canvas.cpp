#include "app/canvas.hpp"

#include <cstddef>
#include <stdexcept>

#include <gd.h>
#include <gdfontl.h>
#include <gdfontmb.h>
#include <gdfonts.h>

namespace slod {
namespace {

int gd_colour(Colour colour)
{
    return gdTrueColor(int(colour.red), int(colour.green), int(colour.blue));
}

gdFontPtr gd_font(Canvas::Font font)
{
    switch (font) {
    case Canvas::Font::Small:
        return gdFontGetSmall();
    case Canvas::Font::Medium:
        return gdFontGetMediumBold();
    case Canvas::Font::Large:
        break;
    }
    return gdFontGetLarge();
}

unsigned char* gd_text(const std::string& words)
{
    return reinterpret_cast<unsigned char*>(const_cast<char*>(words.c_str())); // libgd only reads it
}

} // namespace

void Canvas::Destroy::operator()(gdImageStruct* image) const
{
    gdImageDestroy(image);
}

Canvas::Canvas(int width, int height, Colour background) : image_(gdImageCreateTrueColor(width, height))
{
    if (!image_)
        throw std::runtime_error("no memory for a picture");
    gdImageFilledRectangle(image_.get(), 0, 0, width - 1, height - 1, gd_colour(background));
}

void Canvas::set_pixel(int x, int y, Colour colour)
{
    gdImageSetPixel(image_.get(), x, y, gd_colour(colour));
}

void Canvas::line(int x1, int y1, int x2, int y2, Colour colour)
{
    gdImageLine(image_.get(), x1, y1, x2, y2, gd_colour(colour));
}

void Canvas::frame(int left, int top, int right, int bottom, Colour colour)
{
    gdImageRectangle(image_.get(), left, top, right, bottom, gd_colour(colour));
}

void Canvas::text(int x, int y, const std::string& words, Colour colour, Font font, Align align)
{
    const int width = text_width(words, font);
    const int left = align == Align::Left ? x : align == Align::Centre ? x - width / 2 : x - width;
    gdImageString(image_.get(), gd_font(font), left, y - gd_font(font)->h / 2, gd_text(words),
                  gd_colour(colour));
}

void Canvas::text_upwards(int x, int y, const std::string& words, Colour colour, Font font)
{
    const int bottom = y + text_width(words, font) / 2;
    gdImageStringUp(image_.get(), gd_font(font), x - gd_font(font)->h / 2, bottom, gd_text(words),
                    gd_colour(colour));
}

int Canvas::text_width(const std::string& words, Font font) const
{
    return gd_font(font)->w * int(words.size());
}

Colour Canvas::pixel(int x, int y) const
{
    const int value = gdImageGetTrueColorPixel(image_.get(), x, y);
    return {std::uint8_t(gdTrueColorGetRed(value)), std::uint8_t(gdTrueColorGetGreen(value)),
            std::uint8_t(gdTrueColorGetBlue(value))};
}

std::string Canvas::png() const
{
    int size = 0;
    const std::unique_ptr<void, decltype(&gdFree)> bytes(gdImagePngPtr(image_.get(), &size), &gdFree);
    if (!bytes)
        throw std::runtime_error("no memory for a picture");
    return {static_cast<const char*>(bytes.get()), std::size_t(size)};
}

} // namespace slod
