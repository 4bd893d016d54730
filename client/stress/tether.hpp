#pragma once

#include <string>

namespace slod::stress {

/// A client's line to the program that started it: stdin begins and ends its work, stdout takes one line
/// when it is ready and one with its result. It does not outlive that program.
class Tether {
public:
    /// Throws std::system_error when it cannot be tied.
    Tether();

    /// Says that the client is ready for work.
    void report_ready();

    /// Whether work is to begin, or has begun.
    bool begun();

    /// Whether it is to end, also because the other end is gone.
    bool ended();

    /// Hands over the result.
    void report(const std::string& line);

private:
    void read();

    bool begun_ = false;
    bool ended_ = false;
};

} // namespace slod::stress
