#pragma once

#include <filesystem>
#include <string>

namespace slod {

/// Why no file can be made or replaced at `place`, with the remedy; empty when one can. Writes nothing, so
/// that a program can ask before a long run. A character device, such as /dev/null, is a place too.
std::string unwritable_file(const std::filesystem::path& place);

/// Likewise why `place` is no folder for files, nor can be made into one.
std::string unwritable_folder(const std::filesystem::path& place);

} // namespace slod
