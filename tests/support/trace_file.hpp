#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace slod::test {

/// The columns of what slod-server --trace wrote, by their headings; words are 0. Empty where there is no
/// such file.
inline std::map<std::string, std::vector<double>> read_trace(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    std::vector<std::string> headings;
    std::map<std::string, std::vector<double>> columns;
    for (std::string line; std::getline(stream, line);) {
        std::istringstream row(line);
        std::size_t column = 0;
        for (std::string cell; std::getline(row, cell, ','); ++column)
            if (headings.size() <= column && columns.empty())
                headings.push_back(cell);
            else
                columns[headings.at(column)].push_back(std::strtod(cell.c_str(), nullptr));
    }
    return columns;
}

/// What a frame took, as the trace has it, and the sizes it ran with.
struct TracedFrame {
    double wall_s, work_ms, encode_ms, target_ms, particles, clusters, size, breadth, switches;
};

inline std::vector<TracedFrame> traced_frames(const std::filesystem::path& trace)
{
    auto columns = read_trace(trace);
    std::vector<TracedFrame> frames(columns["frame"].size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto at = [&](const char* heading) { return columns.at(heading)[i]; };
        frames[i] = {.wall_s = at("wall_s"),
                     .work_ms = at("step_ms") + at("encode_ms"),
                     .encode_ms = at("encode_ms"),
                     .target_ms = at("target_ms"),
                     .particles = at("particles"),
                     .clusters = at("clusters"),
                     .size = at("max_cluster_size"),
                     .breadth = at("max_breadth"),
                     .switches = at("splits") + at("merges")};
    }
    return frames;
}

} // namespace slod::test
