#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "stress/draft.hpp"
#include "stress/region_model.hpp"

namespace slod::stress {

/// One client's storm of valid commands about regions of its own: they are added, moved, resized, set and
/// removed at random. Each region has one command under way at most, so that its end is known.
class Storm {
public:
    struct Options {
        std::string prefix;      ///< of the names of its regions, which nobody else must use
        std::size_t regions = 1; ///< at most
        double extent = 1;       ///< regions lie within so far of the origin, in scene lengths
        double lease_s = 60;     ///< of its regions: nobody else may change them
        std::uint64_t seed = 1;
    };

    explicit Storm(const Options& options);

    /// The next command; none while every region has one under way.
    std::optional<Draft> next();

    /// The answer to one of them.
    void on_answer(const Draft& draft, const Reply& reply);

    /// Commands that remove what is there. Nothing must be under way.
    std::vector<Draft> clean_up() const;

    const RegionModel& model() const { return model_; }

private:
    double uniform(double least, double most);
    Vector place();
    Draft draft_for(const std::string& region);

    Options options_;
    std::mt19937_64 random_;
    std::vector<std::string> idle_; ///< regions with nothing under way
    RegionModel model_;
};

/// A command that adds a small box that belongs to its client.
Draft add_box(const std::string& region, const Vector& centre, double half_extent, double lease_s);

} // namespace slod::stress
