#include "stress/limits.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace slod::stress {

namespace {

/// A simulation that has not moved for so long stands still. Clients call it stalled after two seconds; who
/// looks here shares its processor with the load, and may see a frame later than that.
constexpr double longest_standstill_s = 5;

std::string figure(double value)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

/// Collects checks.
class Judge {
public:
    /// `wrong`: why it is not so; empty when it is.
    void is_so(const std::string& claim, const std::string& wrong)
    {
        checks.push_back({wrong.empty(), claim + (wrong.empty() ? "" : ": " + wrong)});
    }

    void none(const std::string& what, std::uint64_t count)
    {
        checks.push_back({count == 0, what + ": " + std::to_string(count)});
    }

    void at_most(const std::string& what, std::optional<double> value, std::optional<double> limit)
    {
        if (limit)
            add(what + " at most " + figure(*limit), value, value && *value <= *limit);
    }

    void at_least(const std::string& what, std::optional<double> value, std::optional<double> limit)
    {
        if (limit)
            add(what + " at least " + figure(*limit), value, value && *value >= *limit);
    }

    std::vector<Check> checks;

private:
    void add(const std::string& claim, std::optional<double> value, bool held)
    {
        checks.push_back({held, claim + ": " + (value ? figure(*value) : "not measured")});
    }
};

/// The worst over the readers that are judged; none when nobody of them took part, or some kind got nothing.
template <class Measure>
std::optional<double> worst(const Report& report, const Measure& measure)
{
    std::optional<double> found;
    for (const ReaderReport& readers : report.readers) {
        if (!counts_against_limits(readers.reader))
            continue;
        if (readers.received == 0)
            return {};
        found = std::max(found.value_or(0), measure(readers));
    }
    return found;
}

void judge_commands(Judge& judge, const CommandReport& commands)
{
    AnswerTally all = commands.valid;
    all.add(commands.rough);
    judge.none("commands without an answer", all.lost);
    judge.none("commands answered in two ways", all.contradicted);
    judge.none("commands answered with another result than is right", all.unexpected);
    judge.none("regions that are not as the answers say", commands.wrong_regions);
    // Who commands under another's name makes the server answer that one again.
    if (!commands.kinds.contains("another's name"))
        judge.none("answers to nothing that was asked", all.surplus());
}

} // namespace

std::vector<Check> checks(const Report& report, const Limits& limits)
{
    Judge judge;
    judge.is_so("the server is there, and the same one, from beginning to end", report.lost_server);
    judge.none("clients that ended without a result", report.missing_workers);
    judge.none("frames that waited for the wire", report.load.delayed_frames);
    judge.none("samples that DDS refused", report.load.refused_samples);
    judge.at_most("longest standstill [s]", report.load.longest_standstill_s, longest_standstill_s);
    if (report.commanders > 0)
        judge_commands(judge, report.commands);
    judge.at_most("loss [%]",
                  worst(report, [](const auto& readers) { return 100 * (1 - readers.delivered); }),
                  limits.loss_percent);
    judge.at_most("latency p99 [ms]",
                  worst(report, [](const auto& readers) { return readers.latency.quantile(0.99); }),
                  limits.latency_ms);
    const DurationHistogram& round_trip = report.commands.round_trip;
    judge.at_most("round trip p99 [ms]",
                  round_trip.count() > 0 ? std::optional(round_trip.quantile(0.99)) : std::nullopt,
                  limits.round_trip_ms);
    judge.at_most("growth of the processor time of a frame [%]",
                  processor_growth_percent(report.rest, report.load), limits.processor_growth_percent);
    judge.at_most("growth of memory [MiB]", memory_growth_mib(report.load), limits.memory_growth_mib);
    judge.at_least("frame rate [Hz]", report.load.frame_rate_hz, limits.frame_rate_hz);
    return judge.checks;
}

bool all_held(const std::vector<Check>& checks)
{
    return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.held; });
}

Json json_of(const std::vector<Check>& checks)
{
    Json list = Json::array();
    for (const Check& check : checks)
        list.push_back({{"claim", check.claim}, {"held", check.held}});
    return list;
}

std::string text_of(const std::vector<Check>& checks)
{
    std::string text;
    for (const Check& check : checks)
        text += (check.held ? "held      " : "NOT HELD  ") + check.claim + "\n";
    return text;
}

} // namespace slod::stress
