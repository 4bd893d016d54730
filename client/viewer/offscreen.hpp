#pragma once

namespace slod::viewer {

/// An OpenGL 3.3 context of this thread's without a screen: Mesa's surfaceless platform, on a graphics card
/// or in software.
class OffscreenContext {
public:
    /// Throws std::runtime_error with a remedy when there can be none.
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

} // namespace slod::viewer
