#include "report/test_runs.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace slod::report {
namespace {

using Json = nlohmann::json;

double number(const Json& json)
{
    if (json.is_number())
        return json.get<double>();
    const auto text = json.get<std::string>();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (text == "nan")
        return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf" || text == "-inf")
        return text == "inf" ? infinite : -infinite;
    throw std::runtime_error("\"" + text + "\" is no number");
}

std::vector<double> numbers(const Json& json)
{
    std::vector<double> result;
    for (const Json& value : json)
        result.push_back(number(value));
    return result;
}

test::CasePicture picture_of(const Json& json)
{
    test::CasePicture picture{.title = json.at("title"),
                              .x_axis = json.at("x_axis"),
                              .y_axis = json.at("y_axis"),
                              .curves = {},
                              .log_x = json.at("log_x"),
                              .log_y = json.at("log_y")};
    for (const Json& curve : json.at("curves")) {
        picture.curves.push_back({curve.at("name"), numbers(curve.at("x")), numbers(curve.at("y"))});
        if (picture.curves.back().x.size() != picture.curves.back().y.size())
            throw std::runtime_error("the curve \"" + picture.curves.back().name +
                                     "\" has not as many x as y");
    }
    return picture;
}

TestRun run_of(const Json& json)
{
    TestRun run{.test = json.at("test"),
                .number = json.at("case"),
                .passed = json.at("passed"),
                .ended = json.at("ended")};
    for (const Json& row : json.at("rows"))
        run.rows.push_back({row.at("quantity"),
                            number(row.at("measured")),
                            {number(row.at("least")), number(row.at("most"))}});
    for (const Json& picture : json.at("pictures"))
        run.pictures.push_back(picture_of(picture));
    return run;
}

} // namespace

double Measurement::room() const
{
    return std::isnan(measured) ? -std::numeric_limits<double>::infinity()
                                : std::min(measured - limits.least, limits.most - measured);
}

bool Measurement::held() const
{
    return std::isfinite(limits.least) || std::isfinite(limits.most);
}

TestRuns read_test_runs(const std::filesystem::path& folder)
{
    TestRuns result;
    if (!std::filesystem::is_directory(folder)) {
        result.problems.push_back(folder.string() +
                                  " is missing; run tests of cases with SLOD_CASE_ROWS set to it");
        return result;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json")
            continue;
        try {
            std::ifstream stream(entry.path());
            result.runs.push_back(run_of(Json::parse(stream)));
        } catch (const std::exception& error) {
            result.problems.push_back(entry.path().string() + ": " + error.what() +
                                      "; remove it and run its test again");
        }
    }
    std::sort(result.runs.begin(), result.runs.end(),
              [](const TestRun& a, const TestRun& b) { return a.test < b.test; });
    return result;
}

} // namespace slod::report
