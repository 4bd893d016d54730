#include "stress/report.hpp"

#include <algorithm>

namespace slod::stress {

namespace {

constexpr std::size_t max_problems = 10;

/// The highest number of each stream that any reader got.
std::map<std::string, Span> latest_of(const std::vector<SubscriberResult>& results)
{
    std::map<std::string, Span> latest;
    for (const SubscriberResult& result : results)
        for (const auto& [region, span] : result.open)
            if (latest[region].last < span.last)
                latest[region] = span;
    return latest;
}

void append(std::vector<std::string>& problems, const std::vector<std::string>& more)
{
    for (const std::string& problem : more)
        if (problems.size() < max_problems)
            problems.push_back(problem);
}

} // namespace

std::vector<ReaderReport> report_of(const std::vector<SubscriberResult>& results, double seconds)
{
    const std::map<std::string, Span> latest = latest_of(results);
    std::vector<ReaderReport> reports;
    for (std::size_t kind = 0; kind < names(Reader{}).size(); ++kind) {
        ReaderReport report{.reader = Reader(kind)};
        double delivered = 0;
        double bytes = 0;
        for (const SubscriberResult& result : results) {
            if (result.reader != report.reader)
                continue;
            ++report.readers;
            report.visits += result.visits;
            report.received += result.received;
            report.latency.add(result.latency);
            bytes += double(result.bytes);
            // Who got nothing at all has lost everything; who only came and went may have met no sample.
            const bool nothing = result.received == 0 && result.visits <= 1;
            delivered += nothing ? 0 : delivered_share(result.received, result.sent, result.open, latest);
        }
        if (report.readers == 0)
            continue;
        report.delivered = delivered / double(report.readers);
        report.mb_s = seconds > 0 ? bytes * 1e-6 / seconds : 0;
        reports.push_back(report);
    }
    return reports;
}

CommandReport report_of(const std::vector<CommanderResult>& results)
{
    CommandReport report;
    for (const CommanderResult& result : results) {
        report.valid.add(result.valid);
        report.rough.add(result.rough);
        report.round_trip.add(result.round_trip);
        report.wrong_regions += result.wrong_regions.size();
        for (const auto& [kind, count] : result.kinds)
            report.kinds[kind] += count;
        append(report.problems, result.wrong_answers);
        append(report.problems, result.wrong_regions);
    }
    return report;
}

} // namespace slod::stress
