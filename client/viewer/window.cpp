#include "viewer/window.hpp"

#include <stdexcept>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace slod::viewer {

namespace {

[[noreturn]] void fail(const std::string& what)
{
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw std::runtime_error(what + (reason ? ": " + std::string(reason) : "") +
                             "; start it on a desktop, or draw without a screen with --screenshot FILE");
}

/// Pixels of the picture per unit of GLFW's places.
view::Pixel pixels_per_unit(GLFWwindow* window)
{
    int width = 1, height = 1;
    view::Viewport picture;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &picture.width, &picture.height);
    return {double(picture.width) / width, double(picture.height) / height};
}

} // namespace

Window::Library::Library()
{
    if (!glfwInit())
        fail("there is no screen to open a window on");
}

Window::Library::~Library()
{
    glfwTerminate();
}

/// Dear ImGui's own callbacks, installed later, call these.
void Window::watch_input()
{
    glfwSetWindowUserPointer(window_, this);
    static const auto self = [](GLFWwindow* window) -> Window& {
        return *static_cast<Window*>(glfwGetWindowUserPointer(window));
    };
    static const auto touch = [](GLFWwindow* window) { self(window).input_.touched = true; };
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double) { touch(window); });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int) { touch(window); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { touch(window); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { touch(window); });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        touch(window);
        const view::Pixel scale = pixels_per_unit(window);
        self(window).cursor_ = {x * scale.x, y * scale.y};
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        touch(window);
        if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS)
            self(window).input_.press = self(window).cursor_;
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        touch(window);
        if (action == GLFW_PRESS)
            self(window).input_.keys.push_back({.key = key, .control = (modifiers & GLFW_MOD_CONTROL) != 0});
    });
}

Window::Window(const view::Viewport& size, const std::string& title)
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (!window_)
        fail("no window with OpenGL 3.3 can be opened");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    watch_input();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // leaves no file behind
    ImGui::StyleColorsDark();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 330");
}

Window::~Window()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
}

bool Window::closing() const
{
    return glfwWindowShouldClose(window_);
}

bool Window::wait_for_input(double seconds)
{
    glfwWaitEventsTimeout(seconds);
    return input_.touched;
}

view::Viewport Window::viewport() const
{
    view::Viewport size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
}

void Window::begin_panels()
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::end_panels()
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show()
{
    glfwSwapBuffers(window_);
}

} // namespace slod::viewer
