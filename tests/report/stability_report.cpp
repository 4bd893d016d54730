#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include "idl/option_checks.hpp"
#include "idl/version.hpp"
#include "report/page.hpp"
#include "report/pictures.hpp"
#include "report/tables.hpp"

namespace {

void write(const std::filesystem::path& file, const std::string& content)
{
    std::ofstream stream(file, std::ios::binary);
    stream << content;
    if (!stream.flush())
        throw std::runtime_error("cannot write " + file.string() +
                                 "; name a folder that may be written to and has room");
}

constexpr int done = 0, test_failed = 1, wrong = 2;

} // namespace

int main(int argc, char** argv)
try {
    using namespace slod;
    CLI::App app("Makes of what tests of hard cases measured a table, stability.txt, stability.csv and "
                 "stability.html, and prints the first.\n"
                 "Exit codes: 0 done, 1 a test failed, 2 something is wrong with a file or a name.");
    std::string rows, cases, out;
    app.add_option("--rows", rows, "What SLOD_CASE_ROWS named when the tests ran")
        ->required()
        ->option_text("FOLDER");
    app.add_option("--cases", cases, "The catalogue: G.toml, F.toml, S.toml, N.toml")
        ->required()
        ->option_text("FOLDER");
    app.add_option("--out", out, "For the files, which replace older ones")
        ->required()
        ->check(writable_folder())
        ->option_text("FOLDER");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? done : wrong;
    }
    const std::filesystem::path folder(out);
    std::filesystem::create_directories(folder);
    report::Findings findings = report::find(report::read_catalogue(cases), report::read_test_runs(rows));
    const auto pictures = report::draw_pictures(findings, folder / "pictures");
    const std::string table = report::table_text(findings);
    write(folder / "stability.txt", table);
    write(folder / "stability.csv", report::csv_text(findings));
    write(folder / "stability.html",
          report::html_page(findings, pictures, "SLOD " + std::string(version()) + "."));
    std::printf("%s", table.c_str());
    return findings.count(report::Outcome::Failed) > 0 ? test_failed
           : findings.problems.empty()                 ? done
                                                       : wrong;
} catch (const std::exception& error) {
    std::fprintf(stderr, "stability-report: %s\n", error.what());
    return 2;
}
