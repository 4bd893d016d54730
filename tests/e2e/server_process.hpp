#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace slod {

/// The real server as a child process. It is found beside the test program.
class ServerProcess {
public:
    explicit ServerProcess(const std::vector<std::string>& arguments);
    ~ServerProcess(); ///< kills it if it still runs
    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;

    /// Waits until it has printed `text`. False when it ended, or hung, without.
    bool prints(std::string_view text);

    void signal(int number) const;

    /// Waits until it has ended. Its exit code; 1000 plus the signal that killed it, which is how a
    /// server that hangs ends too.
    int wait();

    /// What it has printed so far, to stdout and stderr.
    const std::string& output() const { return output_; }

private:
    using Clock = std::chrono::steady_clock;

    /// Reads what comes next. False when nothing will, or nothing does before `deadline`.
    bool read_more(Clock::time_point deadline);

    pid_t process_ = -1;
    int pipe_ = -1;
    bool hung_ = false;
    std::string output_;
};

/// Runs the server to its end.
struct ServerRun {
    int exit_code;
    std::string output;
};
ServerRun run_server(const std::vector<std::string>& arguments);

} // namespace slod
