#include "stress/tether.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <system_error>
#include <unistd.h>

namespace slod::stress {

/// The signal ends a client that is stopped, too, which would never see that its stdin was closed.
Tether::Tether()
{
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot be tied to the parent process");
}

void Tether::report_ready()
{
    report("ready");
}

bool Tether::begun()
{
    read();
    return begun_;
}

bool Tether::ended()
{
    read();
    return ended_;
}

void Tether::report(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

void Tether::read()
{
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (ended_ || poll(&input, 1, 0) <= 0)
        return;
    std::array<char, 16> bytes;
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    begun_ = begun_ || count > 0;
    ended_ = count <= 0;
}

} // namespace slod::stress
