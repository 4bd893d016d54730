#pragma once

#include <string>
#include <string_view>
#include <vector>

// What comes from outside, as bytes that may be anything: fed by libFuzzer (`./dev fuzz`), by the files in
// tests/fuzz/corpus, and by mutations of sound input in the quick tests. A crash or a report of a sanitizer
// speaks for itself; what else may be wrong is said.
namespace slod::test {

/// How an input was dealt with.
struct Dealt {
    bool taken = false;  ///< or it was refused
    std::string wrong{}; ///< what breaks the contract; empty where nothing does
};

/// A scene is read and says itself again, or every problem names the file or the override.
Dealt deal_with_scene(std::string_view text, const std::vector<std::string>& overrides = {});

/// A particle file in GADGET-2's format: all that is read are finite numbers, or every problem names the
/// file.
Dealt deal_with_gadget2(std::string_view bytes);

/// An input log, likewise.
Dealt deal_with_input_log(std::string_view text);

/// Commands as they come out of the inbox, views and frames: each is applied or refused with a reason, and
/// the state is sound after all of them. Taken when one command was applied.
Dealt deal_with_commands(std::string_view bytes);

/// Operations on the tree: regions added, changed and removed, levels of detail, and frames in a scene with
/// births and deaths; the state is sound after each frame. Taken when one operation was.
Dealt deal_with_regions(std::string_view bytes);

} // namespace slod::test
