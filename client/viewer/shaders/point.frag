#version 330 core
flat in vec4 glow;
out vec4 sum;

void main()
{
    sum = glow;
}
