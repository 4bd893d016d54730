#include "viewer/window.hpp"

#include <stdexcept>
#include <utility>

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
void Window::watch(GLFWwindow* window, Input& input)
{
    glfwSetWindowUserPointer(window, &input);
    static const auto input_of = [](GLFWwindow* w) -> Input& {
        return *static_cast<Input*>(glfwGetWindowUserPointer(w));
    };
    static const auto touch = [](GLFWwindow* w) { input_of(w).touched = true; };
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { touch(w); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { touch(w); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { touch(w); });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int) { touch(w); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { touch(w); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { touch(w); });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        touch(w);
        if (action == GLFW_PRESS)
            input_of(w).keys.push_back({.key = key, .control = (modifiers & GLFW_MOD_CONTROL) != 0});
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
    watch(window_, input_);
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
    return std::exchange(input_.touched, false);
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
