#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace slod::stress {

using Vector = std::array<double, 3>;
using Settings = std::vector<std::pair<std::string, std::string>>; ///< setting and value, as in a scene file

/// What is to be commanded: the fields of Command in slod.idl, right or wrong.
struct Draft {
    std::string kind;
    std::string region{};
    std::uint64_t if_revision = 0;
    double lease_s = 0;
    std::uint32_t frames = 0;
    Vector centre{};
    Vector half_extent{};
    double radius = 0;
    Settings settings{};
};

/// What the server answered: of CommandReply, what can be compared.
struct Reply {
    std::string result; ///< "applied", "invalid" and so on
    std::uint64_t applied_frame = 0;
    std::uint64_t revision = 0;

    bool applied() const { return result == "applied"; }

    friend bool operator==(const Reply&, const Reply&) = default;
};

} // namespace slod::stress
