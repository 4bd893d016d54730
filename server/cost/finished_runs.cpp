#include "cost/finished_runs.hpp"

#include <fstream>
#include <stdexcept>

#include "scene/content_hash.hpp"

namespace slod::cost {
namespace {

void append(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream stream(file, std::ios::app);
    stream << text;
    if (!stream.flush())
        throw std::runtime_error("cannot write " + file.string());
}

} // namespace

FinishedRuns::FinishedRuns(std::filesystem::path file, Json circumstances, bool fresh)
    : file_(std::move(file)), circumstances_(std::move(circumstances))
{
    if (fresh)
        std::filesystem::remove(file_);
    bool torn = false;
    std::ifstream stream(file_);
    for (std::string line; std::getline(stream, line);) {
        torn = stream.eof();
        const Json run = Json::parse(line, nullptr, false);
        if (run.is_object() && run.contains("outcome") && run.value("of", Json()) == circumstances_)
            outcomes_[run.value("run", "")] = run["outcome"];
    }
    append(file_, torn ? "\n" : "");
}

const FinishedRuns::Json* FinishedRuns::find(const std::string& run) const
{
    const auto known = outcomes_.find(run);
    return known == outcomes_.end() ? nullptr : &known->second;
}

void FinishedRuns::add(const std::string& run, const Json& outcome)
{
    outcomes_[run] = outcome;
    if (!file_.empty())
        append(file_, Json{{"run", run}, {"of", circumstances_}, {"outcome", outcome}}.dump() + "\n");
}

std::string fingerprint(const Scene& scene, const ParticleSet& initial)
{
    return hash_text(content_hash(to_toml(scene) + hash_text(content_hash(initial)) +
                                  hash_text(content_hash(scene.simulation.colliders))));
}

} // namespace slod::cost
