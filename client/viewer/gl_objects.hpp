#pragma once

#include <utility>

#include <epoxy/gl.h>

/// Owners of OpenGL's objects. A context must be current while they live.
namespace slod::viewer {

/// Owns one object; `Kind` makes and destroys it.
template <class Kind>
class GlObject {
public:
    GlObject() : name_(Kind::make()) {}
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept
    {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() { Kind::destroy(name_); } // 0 is ignored

    GLuint name() const { return name_; }

private:
    GLuint name_;
};

struct BufferKind {
    static GLuint make();
    static void destroy(GLuint name);
};
struct VertexArrayKind {
    static GLuint make();
    static void destroy(GLuint name);
};
struct TextureKind {
    static GLuint make();
    static void destroy(GLuint name);
};
struct FramebufferKind {
    static GLuint make();
    static void destroy(GLuint name);
};

using Buffer = GlObject<BufferKind>;
using VertexArray = GlObject<VertexArrayKind>;
using Texture = GlObject<TextureKind>;
using Framebuffer = GlObject<FramebufferKind>;

/// A shader program.
class Program {
public:
    /// From the texts of its shaders. Throws std::runtime_error with the driver's words when they do not
    /// compile or link.
    Program(const char* vertex_text, const char* fragment_text);
    ~Program() { glDeleteProgram(name_); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const { glUseProgram(name_); }

    // Of the program in use.
    void set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }
    void set(const char* uniform, float x, float y) const { glUniform2f(place(uniform), x, y); }
    void set(const char* uniform, int texture_unit) const { glUniform1i(place(uniform), texture_unit); }

private:
    GLint place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

    GLuint name_;
};

/// A picture to draw into that no screen shows.
class Target {
public:
    /// `format` is a sized colour format, such as GL_RGBA8. Throws std::runtime_error when the driver cannot.
    Target(int width, int height, GLenum format);

    GLuint framebuffer() const { return framebuffer_.name(); }
    GLuint texture() const { return texture_.name(); }
    int width() const { return width_; }
    int height() const { return height_; }

private:
    Texture texture_;
    Framebuffer framebuffer_;
    int width_, height_;
};

} // namespace slod::viewer
