#include "viewer/gl_objects.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace slod::viewer {

namespace {

/// Compiles one shader of a program; the program keeps it alive.
void attach(GLuint program, GLenum kind, const char* text)
{
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return;
    std::array<char, 1024> words{};
    glGetShaderInfoLog(shader, GLsizei(words.size()), nullptr, words.data());
    glDeleteProgram(program);
    throw std::runtime_error("the graphics driver refuses a shader: " + std::string(words.data()));
}

} // namespace

GLuint BufferKind::make()
{
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
}

void BufferKind::destroy(GLuint name)
{
    glDeleteBuffers(1, &name);
}

GLuint VertexArrayKind::make()
{
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
}

void VertexArrayKind::destroy(GLuint name)
{
    glDeleteVertexArrays(1, &name);
}

GLuint TextureKind::make()
{
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
}

void TextureKind::destroy(GLuint name)
{
    glDeleteTextures(1, &name);
}

GLuint FramebufferKind::make()
{
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return name;
}

void FramebufferKind::destroy(GLuint name)
{
    glDeleteFramebuffers(1, &name);
}

Program::Program(const char* vertex_text, const char* fragment_text) : name_(glCreateProgram())
{
    attach(name_, GL_VERTEX_SHADER, vertex_text);
    attach(name_, GL_FRAGMENT_SHADER, fragment_text);
    glLinkProgram(name_);
    GLint linked = 0;
    glGetProgramiv(name_, GL_LINK_STATUS, &linked);
    if (linked)
        return;
    std::array<char, 1024> words{};
    glGetProgramInfoLog(name_, GLsizei(words.size()), nullptr, words.data());
    glDeleteProgram(name_);
    throw std::runtime_error("the graphics driver refuses a program: " + std::string(words.data()));
}

Target::Target(int width, int height, GLenum format) : width_(width), height_(height)
{
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("the graphics driver cannot draw a picture of " + std::to_string(width) +
                                 " by " + std::to_string(height) + " pixels; ask for a smaller one");
}

} // namespace slod::viewer
