#pragma once

#include <memory>
#include <string>

#include "idl/colour_map.hpp"

struct gdImageStruct;

namespace slod {

/// A true-colour picture to draw on, with libgd. Places are in pixels from the top left corner.
class Canvas {
public:
    /// Throws std::runtime_error for want of memory.
    Canvas(int width, int height, Colour background);

    void set_pixel(int x, int y, Colour colour);
    void line(int x1, int y1, int x2, int y2, Colour colour);
    void frame(int left, int top, int right, int bottom, Colour colour);

    enum class Font { Small, Medium, Large };
    enum class Align { Left, Centre, Right };

    /// One line of text in one of libgd's own bitmap fonts (Latin-2). `x` is the edge that `align` names, or
    /// the middle; `y` is the middle of the line.
    void text(int x, int y, const std::string& words, Colour colour, Font font = Font::Medium,
              Align align = Align::Left);

    /// Likewise upwards; `y` is the middle of the text.
    void text_upwards(int x, int y, const std::string& words, Colour colour, Font font = Font::Medium);

    int text_width(const std::string& words, Font font) const;

    Colour pixel(int x, int y) const;

    /// The picture as a PNG file.
    std::string png() const;

private:
    struct Destroy {
        void operator()(gdImageStruct* image) const;
    };

    std::unique_ptr<gdImageStruct, Destroy> image_;
};

} // namespace slod
