#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/input_log.hpp"
#include "app/requests.hpp"
#include "scene/server_settings.hpp"
#include "sim/simulation.hpp"

namespace slod {

/// Whether all of these are settings of [background], which is a region.
bool are_of_background(const std::vector<Assignment>& settings);

/// What is wrong with settings that no scene can change while it runs, by their tables; empty when all may
/// be.
Problems unchangeable(const std::vector<Assignment>& settings);

/// Changes a running simulation, and keeps account of it: who owns which region, what the input log must have
/// to repeat it, what clients are to be told. Belongs to the simulation's thread. `frame` is always the first
/// frame that has the change.
class SceneEditor {
public:
    /// With the regions that the scene has already, owned by nobody.
    explicit SceneEditor(Simulation& simulation);

    /// Null when there is no region of this name.
    const RegionRecord* find(std::string_view name) const;
    std::size_t region_count() const { return records_.size(); }     ///< the background included
    const auto& records() const { return records_; }                 ///< by name
    std::uint64_t revision() const { return revisions_; }            ///< grows with every change of a region
    std::uint64_t effect_changes() const { return effect_changes_; } ///< of any setting
    std::uint64_t plan_changes() const { return plan_changes_; }     ///< of those: other work than before

    // What is asked for wrongly is refused with a sentence per problem, the key first, and changes nothing.
    Problems add(const RegionOfInterest& region, const wire::Uuid& owner, double lease_s,
                 std::uint64_t frame);
    Problems change(const RegionOfInterest& region, std::uint64_t frame); ///< of its name; must be there
    Problems remove(const std::string& name, std::uint64_t frame);        ///< must be there
    /// Settings by table.key; those of [background] are the region's, and stand alone. Refused where `limits`
    /// are of what the scene would not conserve then.
    Problems set(const std::vector<Assignment>& settings, std::uint64_t frame,
                 const AlarmSettings& limits = {});

    const SimulationSettings& scene() const { return simulation_.settings(); } ///< as it is

    /// Gives the whole scene a level of detail; false when it has that already.
    bool set_detail(const Detail& detail, std::uint64_t frame);

    /// Does again what a log says was done.
    Problems repeat(const LoggedCommand& command);

    /// What was done since the last call, in order.
    std::vector<LoggedCommand> take_log() { return std::exchange(log_, {}); }
    /// The newest record of every region that changed since the last call; at the first, of all.
    std::vector<RegionRecord> take_news();

private:
    Problems set_background(const std::vector<Assignment>& settings, std::uint64_t frame);
    void tell(const RegionRecord& record) { news_[record.settings.name] = record; }

    Simulation& simulation_;
    std::map<std::string, RegionRecord, std::less<>> records_;
    std::map<std::string, RegionRecord> news_;
    std::vector<LoggedCommand> log_;
    std::uint64_t revisions_ = 0; ///< given out so far
    std::uint64_t effect_changes_ = 0, plan_changes_ = 0;
};

} // namespace slod
