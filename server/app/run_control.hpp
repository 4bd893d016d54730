#pragma once

#include <cstdint>

namespace slod {

/// Whether the simulation goes on: running, paused, or so many steps from a pause.
class RunControl {
public:
    void pause()
    {
        paused_ = true;
        steps_ = 0;
    }
    void resume() { paused_ = false; }

    /// Lets so many more frames run; only while paused.
    void step(std::uint32_t frames) { steps_ += frames; }

    void stop() { stopped_ = true; }

    bool paused() const { return paused_; }
    bool stopped() const { return stopped_; }

    /// Whether the next frame may run.
    bool may_run() const { return !paused_ || steps_ > 0; }

    /// A frame was completed.
    void count_frame()
    {
        if (paused_ && steps_ > 0)
            --steps_;
    }

private:
    bool paused_ = false;
    bool stopped_ = false;
    std::uint64_t steps_ = 0;
};

} // namespace slod
