#pragma once

/// The texts of shaders/*, compiled in.
namespace slod::viewer::shaders {

extern const char* const point_vert;
extern const char* const point_frag;
extern const char* const ellipse_vert;
extern const char* const ellipse_frag;
extern const char* const whole_vert;
extern const char* const tone_frag;
extern const char* const line_vert;
extern const char* const line_frag;

} // namespace slod::viewer::shaders
