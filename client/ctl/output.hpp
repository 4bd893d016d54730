#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/connection.hpp"

namespace slod::ctl {

using Json = nlohmann::ordered_json; ///< keeps the order below, which is the order of the text output

/// The fields of what is known, named as in slod.idl. NaN becomes null.
Json json_of(const client::Status& status);
Json json_of(const client::ServerInfo& server);
Json json_of(const client::ServerStats& stats);
Json json_of(const client::MeasuredError& error);
Json json_of(const client::EffectInfo& effect);
Json json_of(const client::RegionInfo& region);
Json json_of(const client::StreamMeter::Report& traffic);

/// Prints a JSON object, or its fields with dotted names one per line, to stdout and flushes it.
void print(const Json& object, bool as_json);

/// Its fields with dotted names, one per line.
std::vector<std::string> lines_of(const Json& object);

/// Prints objects with the same fields, a line each below the fields' names; the text goes as --centre and
/// the like take it.
void print_table(const std::vector<Json>& rows);

/// Prints one line to stdout.
void print_line(const std::string& line);

/// One line, "a=1 b.c=2".
std::string one_line(const Json& object);

/// Prints one sentence to stderr.
void complain(const std::string& sentence);

} // namespace slod::ctl
