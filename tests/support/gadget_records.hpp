#pragma once

#include <cstdint>
#include <string>
#include <vector>

// What GADGET-2 files (SnapFormat 1, Springel 2005) are made of.
namespace slod::test {

/// The items as they lie in memory.
template <class T>
std::string bytes_of(const std::vector<T>& items)
{
    return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

/// A record of Fortran: its length in bytes before and behind.
inline std::string record(const std::string& payload)
{
    const std::string mark = bytes_of<std::uint32_t>({std::uint32_t(payload.size())});
    return mark + payload + mark;
}

} // namespace slod::test
