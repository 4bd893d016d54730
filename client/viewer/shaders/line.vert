#version 330 core
layout(location = 0) in vec3 seen;   // from the eye: right, up, along the sight
layout(location = 1) in vec4 colour;
uniform vec2 focal;                  // of the picture's half width and height
uniform float near;
uniform float size;                  // of a point, px
flat out vec4 paint;

void main()
{
    gl_Position = vec4(focal * seen.xy, seen.z - 2.0 * near, seen.z);
    gl_PointSize = size;
    paint = colour;
}
