#pragma once

#include <filesystem>
#include <string_view>

namespace slod {

/// A file that appears whole or not at all: written beside its place under a temporary name, synced, and
/// renamed. Made before a long run, it proves that the place can be written. Symlinks stay, and what they
/// lead to is replaced. A character device, such as /dev/null, is written to as it stands.
class OutputFile {
public:
    /// Creates the temporary file. Throws std::system_error, naming the place, when that is impossible or
    /// when a folder, a pipe, a socket or a disk stands there.
    explicit OutputFile(std::filesystem::path place);
    ~OutputFile(); ///< removes the temporary file unless committed
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Writes everything and gives the file its place. Once only. Throws std::system_error.
    void commit(std::string_view content);

private:
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path place_;
    std::filesystem::path temporary_; ///< empty: the place itself is written to
    int descriptor_ = -1;
};

} // namespace slod
