#version 330 core
// A cluster of about a pixel: a small square.
layout(location = 0) in vec2 place;   // px from the top left corner
layout(location = 1) in float light;  // particles per square pixel
layout(location = 2) in vec4 colour;
uniform vec2 viewport;                // px
uniform float exposure;
uniform float size;                   // px
flat out vec4 glow;                   // coloured light, and light

void main()
{
    gl_Position = vec4(2.0 * place.x / viewport.x - 1.0, 1.0 - 2.0 * place.y / viewport.y, 0.0, 1.0);
    gl_PointSize = size;
    glow = exposure * light * vec4(colour.rgb, 1.0);
}
