#include "viewer/picture_file.hpp"

#include <cerrno>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include <epoxy/gl.h>
#include <gd.h>

namespace slod::viewer {

namespace {

constexpr std::size_t channels = 4;

struct DestroyImage {
    void operator()(gdImage* image) const { gdImageDestroy(image); }
};

struct FreeBytes {
    void operator()(void* bytes) const { gdFree(bytes); }
};

[[noreturn]] void fail(const std::filesystem::path& path, int error)
{
    throw std::runtime_error("cannot write " + path.string() + ": " + std::generic_category().message(error) +
                             "; name a file in a folder that you may write to");
}

} // namespace

Pixels read_pixels(const view::Viewport& size)
{
    Pixels pixels{.size = size, .bytes{}};
    pixels.bytes.resize(std::size_t(size.width) * std::size_t(size.height) * channels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.bytes.data());
    return pixels;
}

void write_png(const Pixels& pixels, const std::filesystem::path& path)
{
    const auto [width, height] = pixels.size;
    const std::unique_ptr<gdImage, DestroyImage> image(gdImageCreateTrueColor(width, height));
    if (!image)
        throw std::runtime_error("no memory for a picture");
    const std::uint8_t* from = pixels.bytes.data();
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x, from += channels)
            gdImageSetPixel(image.get(), x, y, gdTrueColor(from[0], from[1], from[2]));
    int size = 0;
    const std::unique_ptr<void, FreeBytes> bytes(gdImagePngPtr(image.get(), &size));
    if (!bytes)
        throw std::runtime_error("no memory for a picture");

    std::error_code error;
    const bool device = std::filesystem::is_character_file(path, error); // which is written to as it stands
    const std::filesystem::path place = std::filesystem::weakly_canonical(path, error); // symlinks stay
    const std::filesystem::path unfinished = device ? path : std::filesystem::path(place) += ".unfinished";
    error.clear();
    errno = 0;
    std::ofstream file(unfinished, std::ios::binary);
    file.write(static_cast<const char*>(bytes.get()), size);
    file.close();
    if (file && !device)
        std::filesystem::rename(unfinished, place, error);
    if (file && !error)
        return;
    const int reason = error ? error.value() : errno;
    if (!device)
        std::filesystem::remove(unfinished, error);
    fail(path, reason);
}

} // namespace slod::viewer
