#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/lens.hpp"

struct GLFWwindow;

namespace slod::viewer {

/// A key that was pressed: GLFW's number of it.
struct KeyPress {
    int key;
    bool control; ///< with Ctrl
};

/// What came since it was last asked for.
struct Input {
    bool touched = false; ///< anything came
    std::vector<KeyPress> keys{};
    std::optional<view::Pixel> press{}; ///< where the left button went down
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

    /// Waits for input, at most so long. True when there is any to take.
    bool wait_for_input(double seconds);

    /// Size of what is drawn into [px].
    view::Viewport viewport() const;

    /// What came since the last call, however shortly and wherever the cursor is since: Dear ImGui only knows
    /// how things are when a frame begins.
    Input take_input() { return std::exchange(input_, {}); }

    void begin_panels();
    void end_panels(); ///< draws them
    void show();       ///< makes what was drawn visible

private:
    void watch_input();

    /// GLFW itself.
    struct Library {
        Library();
        ~Library();
    };

    Library library_;
    GLFWwindow* window_ = nullptr;
    Input input_;
    view::Pixel cursor_; ///< at the last event: GLFW itself only tells where it is at this moment
};

} // namespace slod::viewer
