#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "cluster/particles.hpp"
#include "scene/scene.hpp"

namespace slod::cost {

/// The outcomes of finished runs, in a file with a line of JSON for each, so that a sweep that is cut short
/// goes on where it was. What runs depend on besides their setting is in each line too, and lines of other
/// circumstances are as if they were not there.
class FinishedRuns {
public:
    using Json = nlohmann::ordered_json;

    FinishedRuns() = default; ///< remembers without a file

    /// Reads the file, if there is one; `fresh` begins it anew. A line that is none, as the last one of a
    /// program that was killed, is passed over. Throws std::runtime_error where the file cannot be written.
    FinishedRuns(std::filesystem::path file, Json circumstances, bool fresh);

    /// The outcome of the run with this name; null when it has not been finished.
    const Json* find(const std::string& run) const;

    /// Adds an outcome, to the file at once. Throws std::runtime_error where it cannot be written.
    void add(const std::string& run, const Json& outcome);

private:
    std::filesystem::path file_;
    Json circumstances_;
    std::map<std::string, Json> outcomes_; ///< by run
};

/// What a scene comes to, its particles and the files of its colliders included, as 16 hexadecimal digits.
std::string fingerprint(const Scene& scene, const ParticleSet& initial);

} // namespace slod::cost
