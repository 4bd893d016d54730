#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace slod::test {

/// A DDS domain that no other test on this machine uses while this one does.
class FreeDomain {
public:
    FreeDomain();
    ~FreeDomain();
    FreeDomain(const FreeDomain&) = delete;
    FreeDomain& operator=(const FreeDomain&) = delete;

    std::uint32_t number() const { return number_; }
    std::string text() const { return std::to_string(number_); }

private:
    std::uint32_t number_ = 0;
    int lock_ = -1; ///< file descriptor
};

/// A program that runs beside the test, and ends with it at the latest.
class Child {
public:
    explicit Child(const std::vector<std::string>& command);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void signal(int number) const;

    /// Waits for its end and returns the exit code, or 128 plus the signal that ended it.
    int wait();

    /// What it has written so far.
    std::string output() const;
    std::string errors() const;

private:
    std::filesystem::path folder_;
    pid_t process_ = -1; ///< -1 once waited for
    int code_ = -1;
};

/// Calls attempt() until it is true. False after a minute, which is never a measure of anything but a
/// reason to give up.
template <class Attempt>
bool eventually(const Attempt& attempt)
{
    const auto patience_ends = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < patience_ends)
        if (attempt())
            return true;
    return false;
}

} // namespace slod::test
