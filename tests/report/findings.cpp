#include "report/findings.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/formatted.hpp"

namespace slod::report {
namespace {

bool all_digits(std::string_view text)
{
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

void take(TestFindings& test, const Measurement& row)
{
    const auto known = std::find_if(test.rows.begin(), test.rows.end(), [&](const Measurement& other) {
        return other.quantity == row.quantity && other.limits.least == row.limits.least &&
               other.limits.most == row.limits.most;
    });
    if (known == test.rows.end())
        test.rows.push_back(row);
    else if (row.room() < known->room())
        *known = row;
}

/// What comes after the name of a test that runs with several parameters; empty where there is none.
std::string parameter_of(const std::string& test)
{
    const std::size_t name = test.find('.'), slash = test.find('/', name);
    return name == std::string::npos || slash == std::string::npos ? "" : test.substr(slash + 1);
}

void take(TestFindings& test, const TestRun& run)
{
    ++test.runs;
    test.failed += run.passed ? 0 : 1;
    test.ended = test.ended && run.ended;
    const std::string parameter = parameter_of(run.test);
    for (Measurement row : run.rows) {
        if (!parameter.empty() && std::isinf(row.room())) // nothing says which run would be worth showing
            row.quantity += ", " + parameter;
        take(test, row);
    }
    for (test::CasePicture picture : run.pictures) {
        picture.title += parameter.empty() ? "" : ", " + parameter;
        test.pictures.push_back(std::move(picture));
    }
}

/// The case of a run, which is added where no catalogue has it.
CaseFindings& case_of(const TestRun& run, Findings& findings)
{
    const auto known =
        std::find_if(findings.cases.begin(), findings.cases.end(),
                     [&](const CaseFindings& each) { return each.hard_case.number == run.number; });
    if (known != findings.cases.end())
        return *known;
    findings.problems.push_back(run.test + " is a test of no known case; name it by one, or add [" +
                                run.number + "] to tests/stability/cases");
    return findings.cases.emplace_back(CaseFindings{.hard_case = {run.number, "in no catalogue"}});
}

} // namespace

const char* name(Outcome outcome)
{
    switch (outcome) {
    case Outcome::Passed:
        return "passed";
    case Outcome::Failed:
        return "FAILED";
    case Outcome::Struck:
        return "struck";
    case Outcome::NotRun:
        break;
    }
    return "not run";
}

Outcome CaseFindings::outcome() const
{
    if (tests.empty())
        return hard_case.struck.empty() ? Outcome::NotRun : Outcome::Struck;
    const bool failed =
        std::any_of(tests.begin(), tests.end(), [](const TestFindings& test) { return test.failed > 0; });
    return failed ? Outcome::Failed : Outcome::Passed;
}

bool CaseFindings::measured() const
{
    return std::any_of(tests.begin(), tests.end(), [](const TestFindings& test) {
        return std::any_of(test.rows.begin(), test.rows.end(),
                           [](const Measurement& row) { return row.held(); });
    });
}

int Findings::count(Outcome outcome) const
{
    return int(std::count_if(cases.begin(), cases.end(),
                             [&](const CaseFindings& each) { return each.outcome() == outcome; }));
}

std::string Findings::summary() const
{
    const auto unmeasured = std::count_if(cases.begin(), cases.end(), [](const CaseFindings& each) {
        return !each.tests.empty() && !each.measured();
    });
    return formatted("%d of %d cases passed, %d failed, %d struck, %d not run", count(Outcome::Passed),
                     int(cases.size()), count(Outcome::Failed), count(Outcome::Struck),
                     count(Outcome::NotRun)) +
           (unmeasured > 0
                ? formatted("; %d ran and held nothing that was measured to a limit", int(unmeasured))
                : "");
}

std::string plain_name(const std::string& test)
{
    const auto dot = test.find('.');
    std::string suite = test.substr(0, dot), name = dot == std::string::npos ? "" : test.substr(dot);
    // "Instance/Suite" of TEST_P, "Suite/0" of TYPED_TEST, "Instance/Suite/0" of TYPED_TEST_P.
    if (const auto slash = suite.rfind('/');
        slash != std::string::npos && all_digits(suite.substr(slash + 1)))
        suite.resize(slash);
    if (const auto slash = suite.rfind('/'); slash != std::string::npos)
        suite.erase(0, slash + 1);
    return suite + name.substr(0, name.find('/'));
}

Findings find(Catalogue catalogue, TestRuns runs)
{
    Findings findings{.cases = {}, .problems = std::move(catalogue.problems)};
    findings.problems.insert(findings.problems.end(), runs.problems.begin(), runs.problems.end());
    for (HardCase& each : catalogue.cases)
        findings.cases.push_back({.hard_case = std::move(each)});
    for (const TestRun& run : runs.runs) {
        CaseFindings& found = case_of(run, findings);
        if (!found.hard_case.struck.empty())
            findings.problems.push_back(run.test + " is a test of " + run.number +
                                        ", which is struck; take the reason out, or the test");
        const std::string name = plain_name(run.test);
        const auto known = std::find_if(found.tests.begin(), found.tests.end(),
                                        [&](const TestFindings& test) { return test.name == name; });
        take(known == found.tests.end() ? found.tests.emplace_back(TestFindings{.name = name}) : *known, run);
    }
    return findings;
}

} // namespace slod::report
