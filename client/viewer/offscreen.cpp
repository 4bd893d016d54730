#include "viewer/offscreen.hpp"

#include <array>
#include <stdexcept>

#include <epoxy/egl.h>

namespace slod::viewer {

namespace {

[[noreturn]] void fail(const char* what)
{
    throw std::runtime_error("cannot draw without a screen: " + std::string(what) +
                             "; install the packages libegl1 and libgl1-mesa-dri, which draw in software");
}

} // namespace

OffscreenContext::OffscreenContext()
{
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        fail("EGL has no surfaceless platform");
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
        fail("EGL cannot be initialised");
    if (!eglBindAPI(EGL_OPENGL_API))
        fail("EGL has no OpenGL");
    constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               3,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
        eglTerminate(display_);
        fail("OpenGL 3.3 is not available");
    }
}

/// The display stays as it is: it is the process's, and Mesa loses memory with every driver that it unloads.
OffscreenContext::~OffscreenContext()
{
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

} // namespace slod::viewer
