#include "e2e/server_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace slod {
namespace {

/// A server that takes longer hangs. Half of the longest frame that the settings allow, so that one that
/// sleeps through a stop is caught as well; hundreds of times what any of the tests needs.
constexpr std::chrono::seconds patience{50};

std::filesystem::path server_file()
{
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "slod-server";
}

} // namespace

ServerProcess::ServerProcess(const std::vector<std::string>& arguments)
{
    const std::string file = server_file().string();
    std::vector<char*> words{const_cast<char*>(file.c_str())};
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);

    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    const int error = posix_spawn(&process_, file.c_str(), &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    pipe_ = ends[0];
    if (error != 0)
        throw std::system_error(error, std::generic_category(), file);
}

ServerProcess::~ServerProcess()
{
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    close(pipe_);
}

bool ServerProcess::prints(std::string_view text)
{
    const Clock::time_point deadline = Clock::now() + patience;
    while (output_.find(text) == std::string::npos)
        if (!read_more(deadline))
            return false;
    return true;
}

void ServerProcess::signal(int number) const
{
    kill(process_, number);
}

int ServerProcess::wait()
{
    const Clock::time_point deadline = Clock::now() + patience;
    while (read_more(deadline)) {
    }
    if (hung_)
        kill(process_, SIGKILL);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

bool ServerProcess::read_more(Clock::time_point deadline)
{
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd ready{.fd = pipe_, .events = POLLIN, .revents = 0};
    hung_ = poll(&ready, 1, std::max(int(left.count()), 0)) <= 0;
    if (hung_)
        return false;
    std::array<char, 4096> buffer{};
    const ssize_t count = read(pipe_, buffer.data(), buffer.size());
    if (count <= 0)
        return false;
    output_.append(buffer.data(), std::size_t(count));
    return true;
}

ServerRun run_server(const std::vector<std::string>& arguments)
{
    ServerProcess server(arguments);
    const int exit_code = server.wait();
    return {.exit_code = exit_code, .output = server.output()};
}

} // namespace slod
