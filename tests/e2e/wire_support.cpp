#include "e2e/wire_support.hpp"

#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <signal.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

namespace slod::test {

namespace {

std::string text_of(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::filesystem::path new_folder()
{
    std::string path = (std::filesystem::temp_directory_path() / "slod-wire-XXXXXX").string();
    if (!mkdtemp(path.data()))
        throw std::runtime_error("cannot make a folder for a child's output");
    return path;
}

} // namespace

FreeDomain::FreeDomain()
{
    unsetenv("CYCLONEDDS_URI"); // tests stay on loopback, whatever their user works with
    constexpr std::uint32_t domains = 200;
    const auto first = static_cast<std::uint32_t>(getpid());
    for (std::uint32_t i = 0; i < domains; ++i) {
        number_ = 1 + (first + i) % domains;
        const auto file = std::filesystem::temp_directory_path() / ("slod-test-domain-" + text() + ".lock");
        lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0)
            return;
        close(lock_);
    }
    throw std::runtime_error("no DDS domain is free");
}

FreeDomain::~FreeDomain()
{
    close(lock_);
}

Child::Child(const std::vector<std::string>& command) : folder_(new_folder())
{
    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    constexpr int create = O_WRONLY | O_CREAT | O_APPEND;
    posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, (folder_ / "out").c_str(), create, 0600);
    posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, (folder_ / "err").c_str(), create, 0600);
    const int error = posix_spawn(&process_, arguments[0], &streams, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    if (error != 0)
        throw std::runtime_error("cannot start " + command[0]);
}

Child::~Child()
{
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    std::filesystem::remove_all(folder_);
}

void Child::signal(int number) const
{
    if (process_ > 0)
        kill(process_, number);
}

int Child::wait()
{
    if (process_ > 0) {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = -1;
        constexpr int signalled = 128;
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : signalled + WTERMSIG(status);
    }
    return code_;
}

std::string Child::output() const
{
    return text_of(folder_ / "out");
}

std::string Child::errors() const
{
    return text_of(folder_ / "err");
}

} // namespace slod::test
