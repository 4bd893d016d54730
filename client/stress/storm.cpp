#include "stress/storm.hpp"

#include <utility>

namespace slod::stress {

namespace {

/// Sides of the regions by the extent: small ones, which hold little and so leave the simulation's own work
/// what it is.
constexpr double least_size = 0.01, most_size = 0.1;

} // namespace

Storm::Storm(const Options& options) : options_(options), random_(options.seed)
{
    for (std::size_t i = 0; i < options_.regions; ++i)
        idle_.push_back(options_.prefix + std::to_string(i));
}

double Storm::uniform(double least, double most)
{
    return std::uniform_real_distribution(least, most)(random_);
}

Vector Storm::place()
{
    Vector place;
    for (double& coordinate : place)
        coordinate = uniform(-options_.extent, options_.extent);
    return place;
}

std::optional<Draft> Storm::next()
{
    if (idle_.empty())
        return {};
    const auto chosen = std::uniform_int_distribution<std::size_t>(0, idle_.size() - 1)(random_);
    const std::string region = std::exchange(idle_[chosen], idle_.back());
    idle_.pop_back();
    return draft_for(region);
}

/// Half of the changes are moves, as by a hand that drags.
Draft Storm::draft_for(const std::string& region)
{
    const double size = options_.extent * uniform(least_size, most_size);
    if (!model_.contains(region))
        return add_box(region, place(), size, options_.lease_s);
    const double chance = uniform(0, 1);
    if (chance < 0.5)
        return {.kind = "move_roi", .region = region, .centre = place()};
    if (chance < 0.75)
        return {.kind = "resize_roi", .region = region, .half_extent = {size, size / 2, size / 3}};
    if (chance < 0.95) {
        const auto particles = std::uniform_int_distribution(16, 64)(random_);
        return {.kind = "set_roi",
                .region = region,
                .settings = {{"max_cluster_size", std::to_string(particles)}}};
    }
    return {.kind = "remove_roi", .region = region};
}

void Storm::on_answer(const Draft& draft, const Reply& reply)
{
    model_.on_answer(draft, reply);
    idle_.push_back(draft.region);
}

std::vector<Draft> Storm::clean_up() const
{
    std::vector<Draft> drafts;
    for (const auto& [region, state] : model_.regions())
        drafts.push_back({.kind = "remove_roi", .region = region});
    return drafts;
}

Draft add_box(const std::string& region, const Vector& centre, double half_extent, double lease_s)
{
    return {.kind = "add_roi",
            .region = region,
            .lease_s = lease_s,
            .centre = centre,
            .half_extent = {half_extent, half_extent, half_extent},
            .settings = {{"shape", "box"}, {"max_cluster_size", "64"}}};
}

} // namespace slod::stress
