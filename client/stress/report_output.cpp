#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "stress/report.hpp"

namespace slod::stress {

namespace {

Json json_of(const std::optional<double>& value)
{
    return value ? Json(*value) : Json();
}

Json json_of(const ServerUse& use)
{
    return {{"seconds", use.seconds},
            {"frames", use.frames},
            {"frame_rate_hz", use.frame_rate_hz},
            {"published_frames", use.published_frames},
            {"published_mb_s", use.published_mb_s},
            {"delayed_frames", use.delayed_frames},
            {"refused_samples", use.refused_samples},
            {"longest_standstill_s", use.longest_standstill_s},
            {"encode_ms", use.encode_ms},
            {"work_ms", use.work_ms},
            {"processor_ms", json_of(use.processor_ms)},
            {"network_ms", json_of(use.network_ms)},
            {"start_mib", json_of(use.start_mib)},
            {"middle_mib", json_of(use.middle_mib)},
            {"end_mib", json_of(use.end_mib)}};
}

Json json_of(const DurationHistogram& histogram)
{
    return {{"count", histogram.count()},
            {"p50_ms", histogram.quantile(0.5)},
            {"p99_ms", histogram.quantile(0.99)},
            {"p999_ms", histogram.quantile(0.999)}};
}

Json json_of(const ReaderReport& readers)
{
    return {{"reader", names(readers.reader)[std::size_t(readers.reader)]},
            {"readers", readers.readers},
            {"visits", readers.visits},
            {"received", readers.received},
            {"delivered", readers.delivered},
            {"mb_s", readers.mb_s},
            {"latency", json_of(readers.latency)}};
}

Json json_of(const AnswerTally& tally)
{
    return {{"commands", tally.commands},
            {"answers", tally.answers},
            {"lost", tally.lost},
            {"contradicted", tally.contradicted},
            {"unexpected", tally.unexpected},
            {"surplus", tally.surplus()},
            {"results", tally.results}};
}

Json json_of(const CommandReport& commands)
{
    return {{"valid", json_of(commands.valid)},
            {"rough", json_of(commands.rough)},
            {"kinds", commands.kinds},
            {"round_trip", json_of(commands.round_trip)},
            {"wrong_regions", commands.wrong_regions},
            {"problems", commands.problems}};
}

template <class... Values>
std::string formatted(const char* format, Values... values)
{
    std::array<char, 256> text;
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string number(const std::optional<double>& value)
{
    return value ? formatted("%.2f", *value) : "?";
}

std::string text_of(const char* phase, const ServerUse& use)
{
    return formatted("%-9s %6.1f s  %7.2f Hz  %8.2f MB/s;  of a frame %.2f ms of work, %.2f ms encoding;  ",
                     phase, use.seconds, use.frame_rate_hz, use.published_mb_s, use.work_ms, use.encode_ms) +
           number(use.processor_ms) + " ms of processor, " + number(use.network_ms) + " of them DDS's\n";
}

std::string text_of(const DurationHistogram& histogram)
{
    return formatted("p50 %.2f  p99 %.2f  p999 %.2f ms", histogram.quantile(0.5), histogram.quantile(0.99),
                     histogram.quantile(0.999));
}

std::string text_of(const ReaderReport& readers)
{
    const std::string name(names(readers.reader)[std::size_t(readers.reader)]);
    return formatted("%4llu %-12s %6.2f %% delivered  %8.2f MB/s  latency ",
                     static_cast<unsigned long long>(readers.readers), name.c_str(), 100 * readers.delivered,
                     readers.mb_s) +
           text_of(readers.latency) + "\n";
}

std::string text_of(const char* name, const AnswerTally& tally)
{
    if (tally.commands == 0)
        return {};
    std::string text =
        formatted("%-9s %llu commands, %llu lost:", name, static_cast<unsigned long long>(tally.commands),
                  static_cast<unsigned long long>(tally.lost));
    for (const auto& [result, count] : tally.results)
        text += " " + result + " " + std::to_string(count);
    return text + "\n";
}

std::string text_of(const CommandReport& commands)
{
    std::string text = text_of("valid", commands.valid) + text_of("rough", commands.rough);
    if (commands.round_trip.count() > 0)
        text += "answers   after " + text_of(commands.round_trip) + "\n";
    for (const std::string& problem : commands.problems)
        text += "wrong     " + problem + "\n";
    return text;
}

} // namespace

Json json_of(const Report& report)
{
    Json json{{"scene", report.scene},
              {"host", report.host},
              {"version", report.version},
              {"particles", report.particles},
              {"clusters", report.clusters},
              {"sample_bytes", report.sample_bytes},
              {"subscribers", report.subscribers},
              {"commanders", report.commanders},
              {"missing_workers", report.missing_workers},
              {"lost_server", report.lost_server.empty() ? Json() : Json(report.lost_server)},
              {"rest", json_of(report.rest)},
              {"load", json_of(report.load)},
              {"processor_growth_percent", json_of(processor_growth_percent(report.rest, report.load))},
              {"memory_growth_mib", json_of(memory_growth_mib(report.load))},
              {"readers", Json::array()},
              {"commands", json_of(report.commands)}};
    for (const ReaderReport& readers : report.readers)
        json["readers"].push_back(json_of(readers));
    return json;
}

std::string text_of(const Report& report)
{
    std::string text =
        formatted("%s: %llu particles in %llu clusters, samples up to %.3f MB\n", report.scene.c_str(),
                  static_cast<unsigned long long>(report.particles),
                  static_cast<unsigned long long>(report.clusters), double(report.sample_bytes) * 1e-6);
    text += text_of("at rest", report.rest);
    text += text_of("loaded", report.load);
    text += "growth    " + number(processor_growth_percent(report.rest, report.load)) +
            " % of processor a frame over rest and encoding\n";
    text += "memory    " + number(report.load.start_mib) + ", " + number(report.load.middle_mib) + ", " +
            number(report.load.end_mib) + " MiB at start, middle and end\n";
    for (const ReaderReport& readers : report.readers)
        text += text_of(readers);
    return text + text_of(report.commands);
}

} // namespace slod::stress
