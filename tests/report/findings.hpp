#pragma once

#include "report/case_catalogue.hpp"
#include "report/test_runs.hpp"

namespace slod::report {

/// The runs of one test with all its parameters.
struct TestFindings {
    std::string name; ///< "Suite.Name"
    int runs = 0, failed = 0;
    bool ended = true;

    /// Of each quantity and limits the run that left least room.
    std::vector<Measurement> rows{};
    std::vector<test::CasePicture> pictures{};
};

enum class Outcome { Passed, Failed, Struck, NotRun };

const char* name(Outcome outcome);

struct CaseFindings {
    HardCase hard_case;
    std::vector<TestFindings> tests{};

    Outcome outcome() const;
    bool measured() const; ///< something, and held it to a limit
};

struct Findings {
    std::vector<CaseFindings> cases;
    Problems problems;

    int count(Outcome outcome) const;
    std::string summary() const; ///< a line without its end
};

/// The name of a test without its instance and its parameter.
std::string plain_name(const std::string& test);

/// What ran beside what there is to run. A test of a case that is in no catalogue, or struck, is a problem,
/// and in the findings all the same.
Findings find(Catalogue catalogue, TestRuns runs);

} // namespace slod::report
