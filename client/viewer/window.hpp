#pragma once

#include <string>
#include <utility>
#include <vector>

#include "view/camera.hpp"

struct GLFWwindow;

namespace slod::viewer {

/// A key that was pressed: GLFW's number of it.
struct KeyPress {
    int key;
    bool control; ///< with Ctrl
};

/// The window on the screen, its OpenGL 3.3 context, and Dear ImGui in it. One at a time.
class Window {
public:
    /// Throws std::runtime_error with a remedy when there is no screen to open it on.
    Window(const view::Viewport& size, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool closing() const;

    /// Waits for input, at most so long. True when there was any.
    bool wait_for_input(double seconds);

    /// Size of what is drawn into [px].
    view::Viewport viewport() const;

    /// Keys pressed since the last call, however shortly: Dear ImGui only sees those that are held when a
    /// frame begins.
    std::vector<KeyPress> take_keys() { return std::exchange(input_.keys, {}); }

    void begin_panels();
    void end_panels(); ///< draws them
    void show();       ///< makes what was drawn visible

private:
    /// What came since it was last asked for.
    struct Input {
        bool touched = false;
        std::vector<KeyPress> keys;
    };

    static void watch(GLFWwindow* window, Input& input);

    /// GLFW itself.
    struct Library {
        Library();
        ~Library();
    };

    Library library_;
    GLFWwindow* window_ = nullptr;
    Input input_;
};

} // namespace slod::viewer
