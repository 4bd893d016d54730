#include "stress/region_model.hpp"

#include <cstdlib>
#include <sstream>
#include <string_view>

namespace slod::stress {

namespace {

void take_settings(RegionState& region, const Settings& settings)
{
    for (const auto& [setting, value] : settings) {
        if (setting == "shape")
            region.shape = value;
        if (setting == "max_cluster_size")
            region.max_cluster_size = std::strtod(value.c_str(), nullptr);
    }
}

std::string text_of(const Vector& vector)
{
    std::ostringstream text;
    text << vector[0] << "," << vector[1] << "," << vector[2];
    return text.str();
}

/// Collects what differs.
class Comparison {
public:
    explicit Comparison(std::string_view region) : region_(region) {}

    template <class Value>
    void compare(std::string_view what, const Value& told, const Value& must)
    {
        if (told == must)
            return;
        std::ostringstream text;
        text << region_ << ": " << what << " is " << shown(told) << ", but must be " << shown(must);
        problems.push_back(text.str());
    }

    std::vector<std::string> problems;

private:
    static std::string shown(const Vector& value) { return text_of(value); }
    static const std::string& shown(const std::string& value) { return value; }
    static double shown(double value) { return value; }
    static std::uint64_t shown(std::uint64_t value) { return value; }

    std::string_view region_;
};

} // namespace

void RegionModel::on_answer(const Draft& draft, const Reply& reply)
{
    if (!reply.applied())
        return;
    if (draft.kind == "add_roi")
        add(draft);
    const auto found = regions_.find(draft.region);
    if (found == regions_.end())
        return;
    RegionState& region = found->second;
    region.revision = reply.revision;
    if (draft.kind == "move_roi")
        region.centre = draft.centre;
    if (draft.kind == "resize_roi") {
        region.radius = draft.radius;
        region.half_extent = draft.half_extent;
    }
    if (draft.kind == "set_roi")
        take_settings(region, draft.settings);
    if (draft.kind == "remove_roi") {
        regions_.erase(found);
        removed_.insert(draft.region);
    }
}

void RegionModel::add(const Draft& draft)
{
    RegionState& region = regions_[draft.region];
    region = {.shape = {}, .centre = draft.centre, .half_extent = draft.half_extent, .radius = draft.radius};
    take_settings(region, draft.settings);
    removed_.erase(draft.region);
}

std::vector<std::string> RegionModel::problems(const std::map<std::string, RegionState>& told) const
{
    std::vector<std::string> found;
    for (const auto& [name, must] : regions_) {
        const auto present = told.find(name);
        if (present == told.end()) {
            found.push_back(name + ": is not there, but must be");
            continue;
        }
        const RegionState& is = present->second;
        Comparison comparison(name);
        comparison.compare("shape", is.shape, must.shape);
        comparison.compare("centre", is.centre, must.centre);
        if (must.shape == "box")
            comparison.compare("half_extent", is.half_extent, must.half_extent);
        if (must.shape == "sphere")
            comparison.compare("radius", is.radius, must.radius);
        comparison.compare("max_cluster_size", is.max_cluster_size, must.max_cluster_size);
        comparison.compare("revision", is.revision, must.revision);
        found.insert(found.end(), comparison.problems.begin(), comparison.problems.end());
    }
    for (const std::string& name : removed_)
        if (told.contains(name))
            found.push_back(name + ": is there, but was removed");
    return found;
}

} // namespace slod::stress
