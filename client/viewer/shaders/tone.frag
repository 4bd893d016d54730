#version 330 core
// From the sum of all light to what a screen shows: the hue is the light's mean, the brightness its logarithm.
uniform sampler2D light;
uniform sampler2D coarse_light;
uniform vec2 coarse_size;        // what the coarse picture covers, from the top left corner [px]
uniform float height;            // of the picture [px]
out vec4 shown;

void main()
{
    const float contrast = 200.0; // of what is dim, against light of 1 where most particles are
    const float white = 3.0;     // light that takes all of the screen's brightness
    vec2 coarse_place = vec2(gl_FragCoord.x, gl_FragCoord.y + coarse_size.y - height);
    vec4 sum = texelFetch(light, ivec2(gl_FragCoord.xy), 0) + texture(coarse_light, coarse_place / coarse_size);
    sum = min(sum, vec4(1e30)); // what is too bright for floats is infinite
    float brightness = log(1.0 + contrast * sum.a) / log(1.0 + contrast * white);
    shown = vec4(sum.rgb / max(sum.a, 1e-6) * min(brightness, 1.0), 1.0);
}
