// The first experiment of O'Brien, Fisher and Lin 2001 (section 6.1, Figure 8): a fountain whose streams
// start one after the other, without clusters, under the paper's rule and under the smooth controller, at a
// rate of droplets of which this machine needs one and a half frame periods for one stream without clusters.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "idl/gnuplot.hpp"
#include "support/trace_file.hpp"

namespace {

using Json = nlohmann::ordered_json;

constexpr double frame_rate = 30, period_ms = 1000 / frame_rate;
constexpr int stream_starts[] = {0, 150, 300}; // frames: 0, 5 and 10 s
constexpr int frames = 600;
constexpr int settling = 60; ///< frames after a start that may deviate
constexpr double load_begin_s = 15, load_s = 5;

using Frame = slod::test::TracedFrame;
using Settings = std::vector<std::string>; ///< "table.key=value"

/// Starts a program; its process id.
pid_t start(const std::vector<std::string>& words)
{
    std::vector<char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    return child;
}

/// Keeps one processor busy for a while, or two.
pid_t start_load(int processors, double after_s, double for_s)
{
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child != 0)
        return child;
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(for_s);
    const auto spin = [end] {
        while (std::chrono::steady_clock::now() < end) {
        }
    };
    std::optional<std::jthread> other;
    if (processors > 1)
        other.emplace(spin);
    spin();
    other.reset();
    _exit(0);
}

void await(pid_t child)
{
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(
            "a process of the benchmark failed; run slod-server on the scene to see why");
}

class Experiment {
public:
    explicit Experiment(const std::filesystem::path& folder) : trace_(folder / "trace.csv") {}

    std::vector<Frame> run(int frame_count, Settings settings, bool paced, int busy_processors = 0) const
    {
        std::vector<std::string> words{
            SLOD_SERVER, SLOD_SCENE, "--no-dds", "--frames", std::to_string(frame_count), "--trace", trace_};
        if (!paced)
            words.emplace_back("--free-run");
        for (int stream = 0; stream < 3; ++stream)
            settings.push_back("emitter." + std::to_string(stream) + ".rate=" + std::to_string(rate));
        for (const std::string& setting : settings)
            words.insert(words.end(), {"--set", setting});
        const pid_t server = start(words);
        const pid_t load =
            busy_processors > 0 ? start_load(busy_processors, startup_s + load_begin_s, load_s) : 0;
        await(server);
        if (busy_processors > 0)
            await(load);
        return slod::test::traced_frames(trace_);
    }

    double rate = 30'000; ///< droplets a second of each stream
    double startup_s = 0; ///< of the server, until its clock begins

private:
    std::filesystem::path trace_;
};

/// Clusters of these sizes, whatever the frames take.
Settings fixed(double background, double nozzles)
{
    Settings settings{"control.mode=\"off\"", "background.max_cluster_size=" + std::to_string(background)};
    for (int region = 0; region < 3; ++region)
        settings.push_back("region." + std::to_string(region) +
                           ".max_cluster_size=" + std::to_string(nozzles));
    return settings;
}

Settings unclustered()
{
    return fixed(1, 1);
}

template <class Value>
double quantile(const std::vector<Frame>& all, std::size_t first, std::size_t last, double q,
                const Value& value)
{
    std::vector<double> values;
    for (std::size_t i = first; i < std::min(last, all.size()); ++i)
        values.push_back(value(all[i]));
    std::sort(values.begin(), values.end());
    return values.empty() ? std::nan("") : values[std::size_t(q * double(values.size() - 1))];
}

double work(const Frame& frame)
{
    return frame.work_ms;
}

/// Share of the frames from `first` on whose work is this near to `ms`.
double share_near(const std::vector<Frame>& course, std::size_t first, double ms, double relative)
{
    const auto near = [&](const Frame& frame) { return std::abs(frame.work_ms / ms - 1) <= relative; };
    const auto begin = course.begin() + std::ptrdiff_t(std::min(first, course.size()));
    return double(std::count_if(begin, course.end(), near)) / double(course.end() - begin);
}

/// Raises the streams until one of them takes one and a half periods of work without clusters.
void calibrate(Experiment& experiment)
{
    for (int round = 0; round < 4; ++round) {
        const std::vector<Frame> course = experiment.run(130, unclustered(), false);
        const double ms = quantile(course, 95, 130, 0.5, work);
        std::printf("%9.0f droplets a second: %6.1f ms without clusters\n", experiment.rate, ms);
        if (std::abs(ms / (1.5 * period_ms) - 1) < 0.03)
            return;
        experiment.rate = std::round(experiment.rate * 1.5 * period_ms / ms / 100) * 100;
    }
}

/// What is asked of a controlled run.
Json judge(const std::vector<Frame>& course, double cap)
{
    int near = 0, within_10 = 0, counted = 0, at_cap = 0;
    double jump = 0, largest = 0, events = 0;
    const double median = quantile(course, settling, course.size(), 0.5, work);
    for (std::size_t i = 0; i < course.size(); ++i) {
        largest = std::max(largest, course[i].size);
        at_cap += course[i].size >= cap;
        const bool settled = std::none_of(std::begin(stream_starts), std::end(stream_starts), [&](int start) {
            return int(i) >= start && int(i) < start + settling;
        });
        jump = i >= std::size_t(settling) ? std::max(jump, course[i].work_ms / median) : jump;
        if (!settled)
            continue;
        ++counted;
        const double error = std::abs(course[i].work_ms / course[i].target_ms - 1);
        near += error <= 0.05;
        within_10 += error <= 0.1;
        events += course[i].switches / course[i].clusters;
    }
    const auto rate = [&](std::size_t first) {
        const std::size_t last = course.size() - 1;
        return double(last - first) / (course[last].wall_s - course[first].wall_s);
    };
    return {{"frames_within_5_percent", double(near) / counted},
            {"frames_within_10_percent", double(within_10) / counted},
            {"work_ms_median", median},
            {"work_ms_p95", quantile(course, settling, course.size(), 0.95, work)},
            {"largest_over_median", jump},
            {"frames_at_largest_size", double(at_cap) / double(course.size())},
            {"largest_size", largest},
            {"events_per_cluster_and_frame", events / counted},
            {"frame_rate_hz_at_the_end", rate(course.size() - 100)}};
}

/// Frames after `begin_s` until the median work of nine frames has come within a tenth of the target and
/// stays there for ten; -1: not before `end_s`. Single frames say little where processors are fought for.
int settled_after(const std::vector<Frame>& course, double begin_s, double end_s)
{
    int since = 0, steady = 0;
    for (std::size_t i = 9; i < course.size(); ++i) {
        if (course[i].wall_s < begin_s || course[i].wall_s > end_s)
            continue;
        ++since;
        const double ms = quantile(course, i - 8, i + 1, 0.5, work);
        steady = std::abs(ms / course[i].target_ms - 1) <= 0.1 ? steady + 1 : 0;
        if (steady == 10)
            return since - 10;
    }
    return -1;
}

/// Of one busy processor and of two: frames until the work is at its target again after they began and ended,
/// and how many times as long as before the last second of the load took for a cluster.
Json under_loads(const Experiment& experiment)
{
    Json loads;
    for (const int processors : {1, 2}) {
        const std::vector<Frame> course = experiment.run(
            750, {"control.mode=\"smooth\"", "control.largest_cluster_size=1000"}, true, processors);
        const auto cluster_ms = [&](double from_s, double to_s) {
            std::vector<Frame> second;
            for (const Frame& frame : course)
                if (frame.wall_s > from_s && frame.wall_s < to_s)
                    second.push_back(frame);
            return quantile(second, 0, second.size(), 0.5,
                            [](const Frame& frame) { return frame.work_ms / frame.clusters; });
        };
        const double end_s = load_begin_s + load_s;
        loads[processors == 1 ? "one_processor" : "two_processors"] = {
            {"settled_after_frames",
             {settled_after(course, load_begin_s, end_s), settled_after(course, end_s, 1e9)}},
            {"slower", cluster_ms(end_s - 1, end_s) / cluster_ms(load_begin_s - 1, load_begin_s)}};
    }
    return loads;
}

void plot(const std::map<std::string, std::vector<Frame>>& courses, const std::filesystem::path& folder,
          const std::string& picture)
{
    std::ostringstream script;
    script << "set terminal pngcairo size 1200,1100 font 'sans,11'\nset output "
           << slod::gnuplot_quoted(picture) << "\n"
           << "set multiplot layout 3,1\nset key top right\nset xrange [0:" << frames << "]\nset grid\n";
    const std::vector<std::pair<std::string, std::string>> panels{
        {"frames per second", "2"}, {"work of a frame [ms]", "3"}, {"maximum cluster size", "4"}};
    for (const auto& [name, course] : courses) {
        std::ofstream data(folder / (name + ".dat"));
        constexpr std::size_t mean = 5; // frames that the rate is taken over
        for (std::size_t i = mean; i < course.size(); ++i)
            data << i << ' ' << double(mean) / (course[i].wall_s - course[i - mean].wall_s) << ' '
                 << course[i].work_ms << ' ' << course[i].size << '\n';
    }
    for (const auto& [title, column] : panels) {
        script << "set ylabel '" << title << "'\n"
               << (column == "2" ? "set yrange [0:40]\n" : "set logscale y\nset yrange [*:*]\n")
               << (column == "4" ? "set xlabel 'frame'\n" : "") << "plot ";
        for (const auto& [name, course] : courses)
            script << "'" << (folder / (name + ".dat")).string() << "' using 1:" << column
                   << " with lines title '" << name << "', ";
        script << (column == "2" ? "30 dashtype 2 lc 'gray' title 'target'\n"
                   : column == "3"
                       ? std::to_string(0.8 * period_ms) + " dashtype 2 lc 'gray' title 'target'\n"
                       : "30 dashtype 2 lc 'gray' title 'largest in the paper'\n");
    }
    if (const std::string problem = slod::run_gnuplot(script.str()); !problem.empty())
        throw std::runtime_error(problem);
}

} // namespace

int main(int argc, char** argv)
try {
    CLI::App app("The paper's fountain at a held frame rate");
    bool json = false;
    double cap = 30;
    std::string picture;
    app.add_flag("--json", json, "One JSON object on the last line");
    app.add_option("--largest", cap, "Largest cluster size that controllers may use");
    app.add_option("--picture", picture, "Plot rate, work and size over the frames, as PNG");
    CLI11_PARSE(app, argc, argv);

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("slod-frame-rate-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    Experiment experiment(folder);
    const auto begin = std::chrono::steady_clock::now();
    experiment.run(1, {}, false);
    experiment.startup_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    calibrate(experiment);

    const std::string largest = "control.largest_cluster_size=" + std::to_string(cap);
    std::map<std::string, std::vector<Frame>> courses;
    courses["without clusters"] = experiment.run(frames, unclustered(), true);
    courses["paper"] = experiment.run(frames, {largest, "control.mode=\"paper\""}, true);
    courses["smooth"] = experiment.run(frames, {largest, "control.mode=\"smooth\""}, true);
    const Json loads = under_loads(experiment);

    const double size = courses["smooth"].back().size;
    const std::vector<Frame> still = experiment.run(frames, fixed(size, size / 2), true);
    const std::size_t steady = frames - 200;
    const double usual = quantile(still, steady, frames, 0.5, work);

    Json result{{"droplets_per_second", experiment.rate},
                {"fixed_sizes",
                 {{"frames_within_5_percent_of_their_median", share_near(still, steady, usual, 0.05)},
                  {"frames_within_10_percent_of_their_median", share_near(still, steady, usual, 0.1)}}}};
    std::printf("fixed sizes, the machine's own spread: %s\n", result["fixed_sizes"].dump().c_str());
    for (const auto& [name, course] : courses) {
        result[name] = name == "without clusters"
                           ? Json{{"work_ms_at_the_end", quantile(course, frames - 100, frames, 0.5, work)}}
                           : judge(course, cap);
        std::printf("%s: %s\n", name.c_str(), result[name].dump(2).c_str());
    }
    result["faster_at_the_end"] = quantile(courses["without clusters"], frames - 100, frames, 0.5, work) /
                                  quantile(courses["smooth"], frames - 100, frames, 0.5, work);
    result["loads"] = loads;
    std::printf("with clusters %.1f times faster at the end; under loads of %g s: %s\n",
                result["faster_at_the_end"].get<double>(), load_s, loads.dump().c_str());
    if (!picture.empty())
        plot(courses, folder, picture);
    std::filesystem::remove_all(folder);
    if (json)
        std::printf("%s\n", result.dump().c_str());
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench-frame_rate: %s\n", error.what());
    return 1;
}
