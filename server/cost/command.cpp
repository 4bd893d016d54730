#include "cost/command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <thread>
#include <unistd.h>

#include "idl/option_checks.hpp"

namespace slod::cost {
namespace {

/// ", " and what the system calls the processor; nothing where it does not say.
std::string processor_name()
{
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);)
        if (const auto colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos)
            return ", " + line.substr(colon + 2);
    return "";
}

} // namespace

int complain(const Problems& problems)
{
    for (const std::string& problem : problems)
        std::fprintf(stderr, "slod-cost: %s\n", problem.c_str());
    return wrong;
}

int team_size(int threads)
{
    return threads > 0 ? threads : int(std::max(std::thread::hardware_concurrency(), 1U));
}

void add_threads_option(CLI::App& command, int& threads)
{
    command.add_option("--threads", threads, "Threads; without it, one per core")
        ->check(between(1, 1024))
        ->option_text("N");
}

std::string machine_name()
{
    std::array<char, 65> host{};
    gethostname(host.data(), host.size() - 1);
    return std::string(host.data()) + ", " + std::to_string(std::thread::hardware_concurrency()) +
           " processors" + processor_name();
}

} // namespace slod::cost
