#include "support/case_rows.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace slod::test {
namespace {

using Json = nlohmann::ordered_json;

/// Text for what JSON has no number for.
Json number(double value)
{
    return std::isfinite(value) ? Json(value)
           : std::isnan(value)  ? Json("nan")
                                : Json(value > 0 ? "inf" : "-inf");
}

struct CaseRow {
    std::string quantity;
    double measured;
    CaseLimits limits;

    /// Negative beyond a limit.
    double room() const
    {
        return std::isnan(measured) ? -std::numeric_limits<double>::infinity()
                                    : std::min(measured - limits.least, limits.most - measured);
    }
};

/// Of the test that runs.
struct Findings {
    std::vector<CaseRow> rows;
    std::vector<CasePicture> pictures;
};
Findings findings;

bool is_case(std::string_view test)
{
    return test.size() > 4 && std::string_view("GFSN").find(test[0]) != std::string_view::npos &&
           std::isdigit(test[1]) && std::isdigit(test[2]) && test[3] == '_';
}

std::string full_name(const testing::TestInfo& test)
{
    return std::string(test.test_suite_name()) + "." + test.name();
}

Json json_of(const CaseRow& row)
{
    return {{"quantity", row.quantity},
            {"measured", number(row.measured)},
            {"least", number(row.limits.least)},
            {"most", number(row.limits.most)}};
}

Json json_of(const CasePicture& picture)
{
    Json curves = Json::array();
    for (const CaseCurve& curve : picture.curves) {
        Json x = Json::array(), y = Json::array();
        for (const double value : curve.x)
            x.push_back(number(value));
        for (const double value : curve.y)
            y.push_back(number(value));
        curves.push_back({{"name", curve.name}, {"x", x}, {"y", y}});
    }
    return {{"title", picture.title}, {"x_axis", picture.x_axis}, {"y_axis", picture.y_axis},
            {"log_x", picture.log_x}, {"log_y", picture.log_y},   {"curves", curves}};
}

/// Where what a test found is written; empty when nobody asks for it.
std::filesystem::path file_of(const testing::TestInfo& test)
{
    const char* const folder = std::getenv("SLOD_CASE_ROWS");
    if (folder == nullptr || !is_case(test.name()))
        return {};
    std::string name = full_name(test);
    std::replace(name.begin(), name.end(), '/', '-');
    std::filesystem::create_directories(folder);
    return std::filesystem::path(folder) / (name + ".json");
}

void write(const std::filesystem::path& file, const testing::TestInfo& test, bool ended)
{
    Json json = {{"test", full_name(test)},
                 {"case", std::string(test.name(), 3)},
                 {"passed", ended && test.result()->Passed()},
                 {"ended", ended},
                 {"rows", Json::array()},
                 {"pictures", Json::array()}};
    for (const CaseRow& row : findings.rows)
        json["rows"].push_back(json_of(row));
    for (const CasePicture& picture : findings.pictures)
        json["pictures"].push_back(json_of(picture));
    std::ofstream out(file);
    out << json.dump(1) << '\n';
    if (!out.flush())
        ADD_FAILURE() << "cannot write " << file;
}

/// Writes what a case's test found once it has ended, and before that, lest a crash go unseen, that it has
/// not.
class CaseFiles : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo& test) override
    {
        findings = {};
        if (const auto file = file_of(test); !file.empty())
            write(file, test, false);
    }

    void OnTestEnd(const testing::TestInfo& test) override
    {
        if (const auto file = file_of(test); test.result()->Skipped())
            std::filesystem::remove(file);
        else if (!file.empty())
            write(file, test, true);
    }
};

/// The framework has no other moment for it that every program shares.
const bool listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new CaseFiles); // which the framework deletes
    return true;
}();

} // namespace

void expect_limits(std::string_view quantity, double measured, CaseLimits limits, std::source_location where)
{
    const CaseRow row{std::string(quantity), measured, limits};
    if (!(row.room() >= 0))
        ADD_FAILURE_AT(where.file_name(), int(where.line()))
            << quantity << " is " << measured << ", beyond " << limits.least << " to " << limits.most;
    const auto known = std::find_if(findings.rows.begin(), findings.rows.end(),
                                    [&](const CaseRow& other) { return other.quantity == quantity; });
    if (known == findings.rows.end())
        findings.rows.push_back(row);
    else if (row.room() < known->room())
        *known = row;
}

void report_picture(CasePicture picture)
{
    findings.pictures.push_back(std::move(picture));
}

} // namespace slod::test
