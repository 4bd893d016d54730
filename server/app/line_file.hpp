#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace slod {

/// A text file that is written line by line as a run goes. Every function throws std::system_error, naming
/// the place, when it cannot do its part.
class LineFile {
public:
    /// Creates or empties the file.
    explicit LineFile(std::filesystem::path place);

    void add(const std::string& line); ///< without its end
    void flush();                      ///< hands what is in memory to the system
    void sync();                       ///< and to the disk

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void check(bool done) const;

    std::filesystem::path place_;
    std::unique_ptr<std::FILE, Close> file_;
};

} // namespace slod
