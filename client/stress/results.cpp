#include "stress/results.hpp"

#include <utility>

namespace slod::stress {

namespace {

/// As [[bucket, count], ...].
Json json_of(const DurationHistogram& histogram)
{
    Json pairs = Json::array();
    for (const auto& [bucket, count] : histogram.counts())
        pairs.push_back({bucket, count});
    return pairs;
}

DurationHistogram histogram(const Json& json)
{
    DurationHistogram::Counts counts;
    for (const Json& pair : json)
        counts[pair.at(0)] = pair.at(1);
    return DurationHistogram(std::move(counts));
}

Json json_of(const AnswerTally& tally)
{
    return {{"commands", tally.commands},
            {"writes", tally.writes},
            {"answers", tally.answers},
            {"lost", tally.lost},
            {"contradicted", tally.contradicted},
            {"unexpected", tally.unexpected},
            {"results", tally.results}};
}

AnswerTally tally(const Json& json)
{
    return {.commands = json.at("commands"),
            .writes = json.at("writes"),
            .answers = json.at("answers"),
            .lost = json.at("lost"),
            .contradicted = json.at("contradicted"),
            .unexpected = json.at("unexpected"),
            .results = json.at("results")};
}

} // namespace

Json json_of(const SubscriberResult& result)
{
    Json open = Json::object();
    for (const auto& [region, span] : result.open)
        open[region] = {span.first, span.last, span.received};
    return {{"reader", std::uint8_t(result.reader)},
            {"received", result.received},
            {"sent", result.sent},
            {"open", open},
            {"bytes", result.bytes},
            {"visits", result.visits},
            {"latency", json_of(result.latency)}};
}

SubscriberResult subscriber_result(const Json& json)
{
    SubscriberResult result{.reader = Reader(json.at("reader").get<std::uint8_t>()),
                            .received = json.at("received"),
                            .sent = json.at("sent"),
                            .bytes = json.at("bytes"),
                            .visits = json.at("visits"),
                            .latency = histogram(json.at("latency"))};
    for (const auto& [region, span] : json.at("open").items())
        result.open[region] = {.first = span.at(0), .last = span.at(1), .received = span.at(2)};
    return result;
}

Json json_of(const CommanderResult& result)
{
    return {{"valid", json_of(result.valid)},
            {"rough", json_of(result.rough)},
            {"kinds", result.kinds},
            {"round_trip", json_of(result.round_trip)},
            {"wrong_answers", result.wrong_answers},
            {"wrong_regions", result.wrong_regions}};
}

CommanderResult commander_result(const Json& json)
{
    return {.valid = tally(json.at("valid")),
            .rough = tally(json.at("rough")),
            .kinds = json.at("kinds"),
            .round_trip = histogram(json.at("round_trip")),
            .wrong_answers = json.at("wrong_answers"),
            .wrong_regions = json.at("wrong_regions")};
}

} // namespace slod::stress
