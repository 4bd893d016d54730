#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "stress/draft.hpp"

namespace slod::stress {

/// What is compared of a region of interest.
struct RegionState {
    std::string shape;
    Vector centre{};
    Vector half_extent{}; ///< of a box
    double radius = 0;    ///< of a sphere
    double max_cluster_size = 0;
    std::uint64_t revision = 0;
};

/// What one client's regions must be after the answers it got: what was answered "applied" is in force, once
/// and in that order, and nothing else is.
class RegionModel {
public:
    /// Takes in an answer; those about one region come in the order in which the server gave them.
    void on_answer(const Draft& draft, const Reply& reply);

    bool contains(const std::string& region) const { return regions_.contains(region); }
    const std::map<std::string, RegionState>& regions() const { return regions_; } ///< by name

    /// Where the regions that the server tells of differ, one sentence each; others' regions may be among
    /// them.
    std::vector<std::string> problems(const std::map<std::string, RegionState>& told) const;

private:
    void add(const Draft& draft);

    std::map<std::string, RegionState> regions_;
    std::set<std::string> removed_;
};

} // namespace slod::stress
