#pragma once

#include <string>
#include <vector>

namespace slod {

#ifdef SLOD_VALIDATE
inline constexpr bool validating =
    true; ///< debug and sanitizer builds check whole structures after each phase
#else
inline constexpr bool validating = false;
#endif

/// Prints what was claimed and where, and aborts.
[[noreturn]] void assertion_failed(const char* claim, const char* file, int line);

/// Prints what was found wrong with a structure, a sentence a line, and aborts; nothing when that is nothing.
void require_none(const std::vector<std::string>& problems);

} // namespace slod

/// A claim that only a programming error can break. On in every build; for O(1) checks only.
#define SLOD_ASSERT(claim) ((claim) ? void(0) : ::slod::assertion_failed(#claim, __FILE__, __LINE__))
