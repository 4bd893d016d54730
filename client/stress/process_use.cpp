#include "stress/process_use.hpp"

#include <fstream>
#include <sstream>
#include <unistd.h>

namespace slod::stress {

namespace {

/// Empty when the process ends meanwhile.
std::string text_of(const std::string& path)
{
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

} // namespace

ProcessUse use_of_process(std::uint32_t process)
{
    const std::string folder = "/proc/" + std::to_string(process) + "/";
    return {.processor_s = processor_s(text_of(folder + "stat"), double(sysconf(_SC_CLK_TCK))),
            .resident_mib = resident_mib(text_of(folder + "statm"), double(sysconf(_SC_PAGESIZE)))};
}

/// The second field, the name, may hold anything: fields are counted from the last bracket (proc(5)).
std::optional<double> processor_s(const std::string& stat, double ticks_per_s)
{
    const std::size_t bracket = stat.rfind(')');
    if (bracket == std::string::npos)
        return {};
    std::istringstream fields(stat.substr(bracket + 1));
    constexpr int fields_before_user_time = 11;
    std::string skipped;
    for (int i = 0; i < fields_before_user_time; ++i)
        fields >> skipped;
    double user = 0, system = 0;
    if (!(fields >> user >> system))
        return {};
    return (user + system) / ticks_per_s;
}

std::optional<double> resident_mib(const std::string& statm, double page_bytes)
{
    std::istringstream fields(statm);
    double size = 0, resident = 0;
    if (!(fields >> size >> resident))
        return {};
    return resident * page_bytes / (1024.0 * 1024.0);
}

} // namespace slod::stress
