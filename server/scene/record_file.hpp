#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace slod {

/// A file of Fortran records cannot be used; what() says why and what to do.
struct UnusableFile : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads a little-endian file of Fortran's unformatted records: a block of bytes between two 32-bit markers
/// that each give its length. Nothing is allocated before the file is known to hold it. Every function
/// throws UnusableFile.
class RecordFile {
public:
    explicit RecordFile(const std::filesystem::path& file);

    /// Length of the next record by its opening marker, bytes. `block` names it in messages; `expected` is
    /// the payload that a truncated file is said to lack.
    std::uint32_t next_length(const std::string& block, std::uint64_t expected);

    /// The next record, which must hold exactly `count` items.
    template <class T>
    std::vector<T> read(const std::string& block, std::size_t count)
    {
        check_next(block, std::uint64_t{count} * sizeof(T));
        std::vector<T> items(count);
        read_next(block, items.data(), count * sizeof(T));
        return items;
    }

private:
    void check_next(const std::string& block, std::uint64_t expected);
    void read_next(const std::string& block, void* memory, std::size_t bytes);
    void read_bytes(void* memory, std::size_t bytes);

    std::ifstream stream_;
    std::uint64_t size_ = 0;
    std::uint64_t position_ = 0;
};

} // namespace slod
