#pragma once

#include <memory>
#include <string>

namespace slod {

class TerminalSink;

/// The program's log, for as long as it lives: spdlog, asynchronous, to stderr. Level info unless the
/// environment's SPDLOG_LEVEL names another. When the queue is full the oldest lines are dropped: the
/// log never delays a frame. On a terminal a status line stays below the log and is redrawn in place.
class Logging {
public:
    Logging();
    ~Logging(); ///< writes what is queued and takes the status line away
    Logging(const Logging&) = delete;
    Logging& operator=(const Logging&) = delete;

    /// Whether stderr is a terminal; elsewhere there is no status line.
    bool on_terminal() const { return on_terminal_; }

    /// Replaces the status line, cut to the terminal's width. Empty takes it away.
    void show_status(std::string line);

private:
    bool on_terminal_;
    std::shared_ptr<TerminalSink> sink_;
};

} // namespace slod
