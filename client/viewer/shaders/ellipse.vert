#version 330 core
// A cluster with a shape: the box about its ellipse, one instance each.
layout(location = 0) in vec2 place;     // px from the top left corner
layout(location = 1) in vec2 half_size; // px
layout(location = 2) in vec3 conic;     // u = x dx^2 + 2 y dx dy + z dy^2
layout(location = 3) in float light;    // particles per square pixel, in the middle
layout(location = 4) in vec4 colour;
uniform vec2 viewport;                  // px
uniform float exposure;
out vec2 offset;                        // px
flat out vec3 form;
flat out vec4 glow;                     // coloured light, and light

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    offset = (2.0 * corner - 1.0) * half_size;
    vec2 at = place + offset;
    gl_Position = vec4(2.0 * at.x / viewport.x - 1.0, 1.0 - 2.0 * at.y / viewport.y, 0.0, 1.0);
    form = conic;
    glow = exposure * light * vec4(colour.rgb, 1.0);
}
