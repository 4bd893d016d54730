#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stress/draft.hpp"

namespace slod::stress {

/// A command that must be refused, and how.
struct Misuse {
    std::string_view wrong; ///< with what, in a few words
    Draft draft;
    std::string_view right_result;
};

/// Every way of misuse there is: unknown kinds, bad names, numbers that are none or out of range, unknown
/// settings, texts as long as the wire takes, revisions that are not. `box` is a region of the client's own
/// that is there; while the scene runs none of them changes anything.
std::vector<Misuse> misuses(const std::string& box);

} // namespace slod::stress
