#include "support/random_regions.hpp"

#include "support/random_draws.hpp"

namespace slod::test {

Vector3d random_point(Random& random, double extent)
{
    Vector3d point;
    for (double& coordinate : point)
        coordinate = extent * (2 * random.uniform() - 1);
    return point;
}

RegionOfInterest random_region(Random& random, const RegionDraw& draw)
{
    const auto chance = [&](double share) { return random.uniform() < share; };
    const auto length = [&] { return chance(0.05) ? 0.0 : draw.size * random.uniform(); };
    RegionOfInterest region;
    region.precedence = std::int64_t(random.bits() % 5) - 2;
    region.centre = random_point(random, draw.extent);
    region.half_extent = {length(), length(), length()};
    region.radius = length();
    region.direction = 3 * random_direction(random);
    region.up = random_direction(random);
    region.field_of_view_deg = 10 + 120 * random.uniform();
    region.aspect = 0.5 + random.uniform();
    region.near_distance = chance(0.5) ? 0 : 0.2 * draw.size * random.uniform();
    if (chance(0.7))
        region.far_distance = region.near_distance + draw.size * random.uniform();
    const Shape shapes[] = {Shape::Box, Shape::Sphere, Shape::Frustum};
    region.shape = draw.everywhere && chance(0.05) ? Shape::Everywhere : shapes[random.bits() % 3];
    if (draw.by_mass && chance(0.3))
        region.least_mass = 2 * random.uniform();
    if (draw.by_motion && chance(0.3))
        region.most_speed = 1 + 4 * random.uniform();
    if (draw.by_motion && chance(0.2))
        region.least_acceleration = random.uniform();
    return region;
}

RegionRow region_by_turns(const std::vector<RegionIndex::Entry>& in_order, const Subject& subject)
{
    for (const RegionIndex::Entry& entry : in_order)
        if (entry.test.contains(subject))
            return entry.row;
    return background_row;
}

} // namespace slod::test
