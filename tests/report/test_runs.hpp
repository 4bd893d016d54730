#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/settings.hpp"
#include "support/case_rows.hpp"

namespace slod::report {

/// A measured value beside what it is held to.
struct Measurement {
    std::string quantity;
    double measured = 0;
    test::CaseLimits limits{};

    /// To the nearer limit; negative beyond it, minus infinity of no number.
    double room() const;
    bool holds() const { return room() >= 0; }
    bool held() const; ///< to anything
};

/// One test that ran, as support/case_rows.cpp writes it down.
struct TestRun {
    std::string test;   ///< "Instance/Suite.Name/parameter"
    std::string number; ///< of its case
    bool passed = false;
    bool ended = true; ///< not so where the program crashed or was stopped
    std::vector<Measurement> rows{};
    std::vector<test::CasePicture> pictures{};
};

struct TestRuns {
    std::vector<TestRun> runs; ///< by name
    Problems problems;
};

/// Reads all files *.json of a folder.
TestRuns read_test_runs(const std::filesystem::path& folder);

} // namespace slod::report
