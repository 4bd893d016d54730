#include "app/input_log.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/json_text.hpp"
#include "scene/content_hash.hpp"

namespace slod {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "slod-input-log";
constexpr int format_version = 2;
constexpr const char* no_log = "this is no input log; name the input.log of a run that had --output-dir";

std::uint64_t hash_from(const std::string& text)
{
    std::uint64_t hash = 0;
    const char* end = text.data() + text.size();
    if (text.size() != 16 || std::from_chars(text.data(), end, hash, 16).ptr != end)
        throw std::runtime_error("\"" + text + "\" is not a hash of 16 hexadecimal digits");
    return hash;
}

Json to_json(const InputLogHeader& header)
{
    return {{"format", format_name},
            {"format_version", format_version},
            {"version", header.version},
            {"scene_name", header.scene_name},
            {"scene_text", header.scene_text},
            {"settings", header.settings},
            {"input", header.input.string()},
            {"initial_source", header.initial_source},
            {"initial_hash", hash_text(header.initial_hash)},
            {"folder", header.folder.string()},
            {"surfaces_hash", hash_text(header.surfaces_hash)}};
}

InputLogHeader header_from(const Json& line)
{
    if (!line.is_object() || line.value("format", "") != format_name)
        throw std::runtime_error(no_log);
    if (const int given = line.value("format_version", 0); given != format_version)
        throw std::runtime_error("an input log of format version " + std::to_string(given) +
                                 ", and this server reads " + std::to_string(format_version) +
                                 "; repeat the run with the slod-server that wrote it, version " +
                                 line.value("version", "unknown"));
    return {.version = line.at("version"),
            .scene_name = line.at("scene_name"),
            .scene_text = line.at("scene_text"),
            .settings = line.at("settings"),
            .input = line.at("input").get<std::string>(),
            .initial_source = line.at("initial_source"),
            .initial_hash = hash_from(line.at("initial_hash")),
            .folder = line.at("folder").get<std::string>(),
            .surfaces_hash = hash_from(line.at("surfaces_hash"))};
}

std::vector<std::string> texts_of(const std::vector<Assignment>& settings)
{
    std::vector<std::string> texts;
    for (const Assignment& assignment : settings)
        texts.push_back(assignment.key + "=" + assignment.value);
    return texts;
}

std::vector<Assignment> settings_from(const std::vector<std::string>& texts)
{
    std::vector<Assignment> settings;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos)
            throw std::runtime_error("\"" + text + "\" is no setting");
        settings.push_back({.key = text.substr(0, equals), .value = text.substr(equals + 1)});
    }
    return settings;
}

LoggedCommand command_from(const Json& line)
{
    const std::string name = line.at("command");
    const auto all = names(InputKind{});
    const auto known = std::find(all.begin(), all.end(), name);
    if (known == all.end())
        throw std::runtime_error("unknown command \"" + name + "\"");
    return {.frame = line.at("frame"),
            .kind = InputKind(known - all.begin()),
            .region = line.value("region", ""),
            .settings = settings_from(line.value("settings", std::vector<std::string>()))};
}

/// Makes the folder if need be. A log that is there is kept under another name.
std::filesystem::path log_in(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error("cannot make " + folder.string() + " for the input log: " + error.message() +
                                 "; name a folder that can be written to");
    const std::filesystem::path log = folder / "input.log";
    for (int number = 1; std::filesystem::exists(log); ++number) {
        const std::filesystem::path older = folder / ("input-" + std::to_string(number) + ".log");
        if (!std::filesystem::exists(older))
            std::filesystem::rename(log, older);
    }
    return log;
}

/// Takes in one line after the header.
void read_line(const Json& line, InputLog& log)
{
    if (log.end)
        throw std::runtime_error("nothing may follow the end");
    if (line.contains("command")) {
        LoggedCommand command = command_from(line);
        if (command.frame == 0 || (!log.commands.empty() && command.frame < log.commands.back().frame))
            throw std::runtime_error("frame " + std::to_string(command.frame) + " is out of order");
        log.commands.push_back(std::move(command));
    } else
        log.end = InputLogEnd{.frames = line.at("frames"), .state_hash = hash_from(line.at("state_hash"))};
}

} // namespace

std::variant<InputLog, Problems> read_input_log(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) // opening a pipe may last for ever
        return Problems{file.string() + ": there is no such regular file; name an input log"};
    std::ifstream stream(file);
    if (!stream)
        return Problems{file.string() + ": the input log cannot be read"};
    InputLog log;
    std::size_t line_number = 0;
    try {
        for (std::string text; std::getline(stream, text);) {
            ++line_number;
            const Json line = Json::parse(text);
            if (line_number == 1)
                log.header = header_from(line);
            else
                read_line(line, log);
        }
    } catch (const Json::exception&) {
        return Problems{
            file.string() + ":" + std::to_string(line_number) + ": " +
            (line_number == 1 ? no_log : "the line is damaged, which ends the log; use a whole copy of it")};
    } catch (const std::exception& error) {
        return Problems{file.string() + ":" + std::to_string(line_number) + ": " + error.what()};
    }
    if (line_number == 0)
        return Problems{file.string() + ": the input log is empty; name one of a run that has begun"};
    return log;
}

InputLogWriter::InputLogWriter(const std::filesystem::path& folder, const InputLogHeader& header)
    : file_(log_in(folder))
{
    write_line(json_text(to_json(header)));
}

void InputLogWriter::record(const LoggedCommand& command)
{
    Json line{{"frame", command.frame}, {"command", names(command.kind)[std::size_t(command.kind)]}};
    if (!command.region.empty())
        line["region"] = command.region;
    if (!command.settings.empty())
        line["settings"] = texts_of(command.settings);
    write_line(json_text(line));
}

void InputLogWriter::finish(const InputLogEnd& end)
{
    write_line(json_text({{"frames", end.frames}, {"state_hash", hash_text(end.state_hash)}}));
    file_.sync();
}

void InputLogWriter::write_line(const std::string& line)
{
    file_.add(line);
    file_.flush();
}

} // namespace slod
