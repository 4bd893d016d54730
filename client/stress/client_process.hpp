#pragma once

#include <optional>
#include <string>
#include <sys/types.h>

namespace slod::stress {

/// One client of a run: this program once more, as a process of its own, which is tied to this one.
class ClientProcess {
public:
    /// `order`: what it is to do, as JSON. Throws std::system_error when it cannot be started.
    explicit ClientProcess(const std::string& order);
    ~ClientProcess(); ///< ends it
    ClientProcess(ClientProcess&& other) noexcept;
    ClientProcess(const ClientProcess&) = delete;
    ClientProcess& operator=(const ClientProcess&) = delete;
    ClientProcess& operator=(ClientProcess&&) = delete;

    void begin(); ///< its work
    void end();   ///< likewise: it then reports
    void signal(int number) const;

    /// Takes in what it has written.
    void poll();

    bool ready() const { return ready_; }
    const std::optional<std::string>& result() const { return result_; }

    /// Whether nothing more will come of it.
    bool gone() const { return output_ < 0; }

private:
    void take_lines();

    pid_t process_ = -1;
    int input_ = -1;  ///< file descriptor of its stdin; -1: closed
    int output_ = -1; ///< likewise of its stdout
    std::string written_;
    bool ready_ = false;
    std::optional<std::string> result_;
};

} // namespace slod::stress
