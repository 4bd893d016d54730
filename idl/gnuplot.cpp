#include "idl/gnuplot.hpp"

#include <cstdio>
#include <sys/wait.h>

namespace slod {

// Within single quotes a quote is written twice, and nothing else means anything.
std::string gnuplot_quoted(std::string_view text)
{
    std::string result = "'";
    for (const char letter : text)
        result += letter == '\'' ? "''" : std::string(1, letter);
    return result + "'";
}

/// Where gnuplot cannot open the file it draws to stdout instead, which is for the report.
std::string run_gnuplot(const std::string& script)
{
    constexpr int not_found = 127; // the shell's exit code
    FILE* const gnuplot = popen("gnuplot >/dev/null", "w");
    if (!gnuplot)
        return "no further process can be started; end some";
    const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
    const int status = pclose(gnuplot);
    if (WIFEXITED(status) && WEXITSTATUS(status) == not_found)
        return "gnuplot is missing; install the package gnuplot-nox";
    if (status != 0 || !written)
        return "gnuplot could not write it; name a file in a folder that is there and may be written to";
    return {};
}

} // namespace slod
