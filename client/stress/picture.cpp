#include "stress/picture.hpp"

#include <array>
#include <cstdio>
#include <string_view>

#include "idl/gnuplot.hpp"

namespace slod::stress {

namespace {

template <class... Values>
std::string formatted(const char* format, Values... values)
{
    std::array<char, 256> text;
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string head(const std::string& file, const char* layout, const char* size)
{
    return "set terminal pngcairo size " + std::string(size) + " font 'sans,11'\nset output " +
           gnuplot_quoted(file) + "\nset multiplot layout " + layout + "\nset grid\n";
}

/// "$name << end": a block of data.
std::string block(const std::string& name, const std::string& lines)
{
    return "$" + name + " << end\n" + lines + "end\n";
}

/// Shares that take longer than each of many durations [ms].
std::string tail_of(const DurationHistogram& histogram)
{
    constexpr std::array shares{0.001, 0.01, 0.05, 0.1,  0.2,  0.3,   0.4,   0.5,   0.6,    0.7,
                                0.8,   0.9,  0.95, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995, 0.9999};
    std::string lines;
    for (const double share : shares)
        lines += formatted("%g %g\n", histogram.quantile(share), 1 - share);
    return lines;
}

std::string name_of(const ReaderReport& readers)
{
    std::string name(names(readers.reader)[std::size_t(readers.reader)]);
    if (const std::size_t line = name.find('_'); line != std::string::npos)
        name[line] = ' ';
    return name;
}

const ReaderReport& steady(const Report& report)
{
    static const ReaderReport none{};
    return report.readers.empty() ? none : report.readers.front();
}

} // namespace

std::string load_script(const Report& report, const std::string& file)
{
    std::string data, curves, bars;
    const auto add_curve = [&](const std::string& name, const std::string& title,
                               const DurationHistogram& histogram) {
        if (histogram.count() == 0)
            return;
        data += block(name, tail_of(histogram));
        curves +=
            (curves.empty() ? "plot $" : ", $") + name + " with linespoints title " + gnuplot_quoted(title);
    };
    for (const ReaderReport& readers : report.readers) {
        const std::string name = name_of(readers);
        add_curve("latency" + std::to_string(int(readers.reader)), "latency, " + name, readers.latency);
        bars += gnuplot_quoted(name) + formatted(" %g\n", 100 * readers.delivered);
    }
    add_curve("round_trip", "command to answer", report.commands.round_trip);
    std::string script = head(file, "1,2", "1100,420") + data;
    if (!curves.empty())
        script += "set logscale xy\nset xlabel 'milliseconds'\nset ylabel 'share that takes longer'\n" +
                  curves + "\nunset logscale\n";
    if (!bars.empty())
        script +=
            block("delivered", bars) +
            "set xlabel 'subscribers'\nset ylabel 'delivered [%]'\nset yrange [0:105]\nset style fill solid "
            "0.6\nset boxwidth 0.6\nunset key\nplot $delivered using 0:2:xtic(1) with boxes\n";
    return script;
}

std::string sweep_script(const std::vector<Report>& reports, const std::string& file)
{
    std::string lines;
    for (const Report& report : reports) {
        const ReaderReport& readers = steady(report);
        lines += formatted("%d %g %g %g %g %g\n", int(report.subscribers), 100 * readers.delivered,
                           readers.latency.quantile(0.5), readers.latency.quantile(0.99), readers.mb_s,
                           report.load.frame_rate_hz);
    }
    return head(file, "1,3", "1300,400") + block("sweep", lines) +
           "set logscale x 2\nset xlabel 'subscribers'\n"
           "set ylabel 'received by all [MB/s]'\nset yrange [0:*]\n"
           "plot $sweep using 1:5 with linespoints notitle\n"
           "set ylabel 'delivered [%], frames per second'\nset key bottom left\n"
           "plot $sweep using 1:2 with linespoints title 'delivered [%]', "
           "$sweep using 1:6 with linespoints title 'frames per second'\n"
           "set ylabel 'latency [ms]'\nset logscale y\nset yrange [*:*]\nset key top left\n"
           "plot $sweep using 1:3 with linespoints title 'p50', "
           "$sweep using 1:4 with linespoints title 'p99'\n";
}

std::string sweep_line(const Report& report)
{
    const ReaderReport& readers = steady(report);
    return formatted(
        "%3d subscribers  %7.2f Hz  %6.2f %% delivered  %9.1f MB/s  latency p50 %.2f  p99 %.2f ms\n",
        int(report.subscribers), report.load.frame_rate_hz, 100 * readers.delivered, readers.mb_s,
        readers.latency.quantile(0.5), readers.latency.quantile(0.99));
}

} // namespace slod::stress
