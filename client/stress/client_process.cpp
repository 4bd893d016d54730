#include "stress/client_process.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace slod::stress {

namespace {

/// A pipe whose ends no other client inherits.
std::array<int, 2> new_pipe()
{
    std::array<int, 2> ends;
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot make a pipe to a client");
    return ends;
}

void close_end(int& end)
{
    if (end >= 0)
        close(std::exchange(end, -1));
}

} // namespace

/// In a process group of its own: Ctrl-C in a terminal is for this program, which ends its clients in order.
ClientProcess::ClientProcess(const std::string& order)
{
    std::array<int, 2> input = new_pipe(), output = new_pipe();
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, input[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&streams, output[1], STDOUT_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const std::string program = std::filesystem::read_symlink("/proc/self/exe");
    std::string name = "slod-stress", role = "client", text = order;
    const std::array<char*, 4> arguments{name.data(), role.data(), text.data(), nullptr};
    const int error =
        posix_spawn(&process_, program.c_str(), &streams, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&streams);
    close(input[0]);
    close(output[1]);
    input_ = input[1];
    output_ = output[0];
    if (error != 0) {
        close_end(input_);
        close_end(output_);
        throw std::system_error(error, std::generic_category(), "cannot start a client");
    }
    fcntl(output_, F_SETFL, O_NONBLOCK);
}

ClientProcess::ClientProcess(ClientProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)), input_(std::exchange(other.input_, -1)),
      output_(std::exchange(other.output_, -1)), written_(std::move(other.written_)), ready_(other.ready_),
      result_(std::move(other.result_))
{}

ClientProcess::~ClientProcess()
{
    close_end(input_);
    close_end(output_);
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
}

/// A client that is gone cannot be written to; that it is gone is seen at its stdout.
void ClientProcess::begin()
{
    if (input_ >= 0)
        static_cast<void>(!write(input_, "\n", 1));
}

void ClientProcess::end()
{
    close_end(input_);
}

void ClientProcess::signal(int number) const
{
    if (process_ > 0)
        kill(process_, number);
}

void ClientProcess::poll()
{
    std::array<char, 4096> bytes;
    while (output_ >= 0) {
        const ssize_t count = read(output_, bytes.data(), bytes.size());
        if (count < 0)
            return;
        if (count == 0)
            close_end(output_);
        written_.append(bytes.data(), std::size_t(count));
        take_lines();
    }
}

void ClientProcess::take_lines()
{
    for (std::size_t end = written_.find('\n'); end != std::string::npos; end = written_.find('\n')) {
        const std::string line = written_.substr(0, end);
        written_.erase(0, end + 1);
        if (line == "ready")
            ready_ = true;
        else
            result_ = line;
    }
}

} // namespace slod::stress
