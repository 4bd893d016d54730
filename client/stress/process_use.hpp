#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace slod::stress {

/// What a process has taken of this machine; nothing where the kernel does not say.
struct ProcessUse {
    std::optional<double> processor_s; ///< user and system time of all its threads
    std::optional<double> network_s;   ///< of it, what DDS's own threads took
    std::optional<double> resident_mib;
};

/// From /proc/<process>/stat, statm and task.
ProcessUse use_of_process(std::uint32_t process);

/// Whether a thread of this name is one of Cyclone DDS's.
bool is_network_thread(std::string_view name);

/// From the text of those files, with the kernel's units: ticks per second and bytes per page.
std::optional<double> processor_s(const std::string& stat, double ticks_per_s);
std::optional<double> resident_mib(const std::string& statm, double page_bytes);

} // namespace slod::stress
