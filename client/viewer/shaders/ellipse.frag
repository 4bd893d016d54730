#version 330 core
in vec2 offset;
flat in vec3 form;
flat in vec4 glow;
out vec4 sum;

void main()
{
    float u = form.x * offset.x * offset.x + 2.0 * form.y * offset.x * offset.y + form.z * offset.y * offset.y;
    float rest = max(1.0 - u, 0.0);
    sum = rest * rest * glow;
}
