#include "report/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/number_text.hpp"
#include "idl/gnuplot.hpp"

namespace slod::report {
namespace {

bool shown(double value, bool logarithmic)
{
    return std::isfinite(value) && (!logarithmic || value > 0);
}

/// On one line, as no string of gnuplot's has more.
std::string quoted(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    return gnuplot_quoted(text) + " noenhanced";
}

std::string points(const test::CaseCurve& curve, const test::CasePicture& picture)
{
    std::string lines;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
        if (shown(curve.x[i], picture.log_x) && shown(curve.y[i], picture.log_y))
            lines += number_text(curve.x[i]) + " " + number_text(curve.y[i]) + "\n";
    return lines;
}

} // namespace

std::string plot_script(const test::CasePicture& picture, const std::string& name,
                        const std::filesystem::path& file)
{
    std::string script = "reset\n", curves;
    for (std::size_t i = 0; i < picture.curves.size(); ++i) {
        const std::string lines = points(picture.curves[i], picture);
        if (lines.empty())
            continue;
        const std::string data = "$curve" + std::to_string(i);
        script += data + " << END\n" + lines + "END\n";
        curves += (curves.empty() ? "plot " : ", ") + data + " using 1:2 with lines lw 2 title " +
                  quoted(picture.curves[i].name);
    }
    if (curves.empty())
        return "";
    if (picture.log_x || picture.log_y)
        script +=
            std::string("set logscale ") + (picture.log_x ? "x" : "") + (picture.log_y ? "y" : "") + "\n";
    return script + "set terminal svg size 640,400 name '" + name + "'\nset output " +
           gnuplot_quoted(file.string()) + "\nset grid\nset key below\nset title " + quoted(picture.title) +
           "\nset xlabel " + quoted(picture.x_axis) + "\nset ylabel " + quoted(picture.y_axis) + "\n" +
           curves + "\nset output\n";
}

std::vector<std::pair<std::string, std::string>> draw_pictures(Findings& findings,
                                                               const std::filesystem::path& folder)
{
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::vector<std::pair<std::string, std::filesystem::path>> files;
    std::string script;
    for (const CaseFindings& each : findings.cases)
        for (const TestFindings& test : each.tests)
            for (const test::CasePicture& picture : test.pictures) {
                const std::string name = each.hard_case.number + "_" + std::to_string(files.size());
                const std::filesystem::path file = folder / (name + ".svg");
                const std::string commands = plot_script(picture, name, file);
                if (commands.empty())
                    findings.problems.push_back(test.name + ": the picture \"" + picture.title +
                                                "\" has no point that its axes show; give it some");
                else
                    files.emplace_back(each.hard_case.number, file);
                script += commands;
            }
    const std::string undrawn = script.empty() ? "" : run_gnuplot(script);
    if (!undrawn.empty())
        findings.problems.push_back("no pictures: " + undrawn);
    std::vector<std::pair<std::string, std::string>> pictures;
    for (const auto& [number, file] : files) {
        std::ifstream stream(file);
        pictures.emplace_back(number, std::string(std::istreambuf_iterator<char>(stream), {}));
    }
    return pictures;
}

} // namespace slod::report
