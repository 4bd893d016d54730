#include "stress/process_use.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <unistd.h>

namespace slod::stress {

namespace {

/// Empty when the process ends meanwhile.
std::string text_of(const std::filesystem::path& path)
{
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// Threads may end meanwhile; what ended is left out.
std::optional<double> network_s(const std::string& tasks, double ticks_per_s)
{
    std::optional<double> sum;
    std::error_code error;
    for (const auto& task : std::filesystem::directory_iterator(tasks, error)) {
        const std::string name = text_of(task.path() / "comm");
        if (is_network_thread(name.substr(0, name.find('\n'))))
            sum = sum.value_or(0) + processor_s(text_of(task.path() / "stat"), ticks_per_s).value_or(0);
    }
    return sum;
}

} // namespace

ProcessUse use_of_process(std::uint32_t process)
{
    const std::string folder = "/proc/" + std::to_string(process) + "/";
    const double ticks_per_s = double(sysconf(_SC_CLK_TCK));
    return {.processor_s = processor_s(text_of(folder + "stat"), ticks_per_s),
            .network_s = network_s(folder + "task", ticks_per_s),
            .resident_mib = resident_mib(text_of(folder + "statm"), double(sysconf(_SC_PAGESIZE)))};
}

bool is_network_thread(std::string_view name)
{
    constexpr std::array<std::string_view, 6> starts{"recv", "tev", "gc", "dq.", "xmit", "lease"};
    return std::any_of(starts.begin(), starts.end(),
                       [name](std::string_view start) { return name.starts_with(start); });
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
