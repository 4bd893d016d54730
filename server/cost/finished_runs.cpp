#include "cost/finished_runs.hpp"

#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>

#include <xxhash.h>

#include "cost/formatted.hpp"

namespace slod::cost {
namespace {

struct FreeState {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

/// XXH3 of what is fed to it, bit by bit.
class Fingerprint {
public:
    Fingerprint() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }

    template <class Value>
    void add(std::span<const Value> values)
    {
        static_assert(std::has_unique_object_representations_v<Value> || std::is_floating_point_v<Value>);
        XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
    }

    template <class Value>
    void add(const Value& value)
    {
        add(std::span<const Value>(&value, 1));
    }

    void add(const Vector3d& vector) { add(std::span<const double>(vector.data(), 3)); }

    std::string text() const
    {
        return formatted("%016llx", static_cast<unsigned long long>(XXH3_64bits_digest(state_.get())));
    }

private:
    std::unique_ptr<XXH3_state_t, FreeState> state_;
};

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
    Fingerprint all;
    const std::string text = to_toml(scene);
    all.add(std::span<const char>(text));
    for (const Particle& particle : initial) {
        all.add(particle.position);
        all.add(particle.velocity);
        all.add(particle.id);
        all.add(particle.mass);
        all.add(particle.expiry_frame);
        all.add(particle.kind);
    }
    for (const ColliderSettings& collider : scene.simulation.colliders) {
        if (!collider.mesh)
            continue;
        for (const Vector3d& vertex : collider.mesh->vertices)
            all.add(vertex);
        all.add(std::span<const Mesh::Triangle>(collider.mesh->triangles));
    }
    return all.text();
}

} // namespace slod::cost
