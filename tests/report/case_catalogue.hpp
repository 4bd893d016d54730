#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/settings.hpp"

namespace slod::report {

/// One hard case, as its table in tests/stability/cases says.
struct HardCase {
    std::string number; ///< "G01"
    std::string claim;  ///< a sentence
    std::string note{}, struck{};
};

struct Catalogue {
    std::vector<HardCase> cases; ///< gravity, fields and collisions, clusters, numerics; each in order
    Problems problems;
};

/// Reads G.toml, F.toml, S.toml and N.toml of a folder. Cases that are in none of them are among the
/// problems, as is whatever else is in them.
Catalogue read_catalogue(const std::filesystem::path& folder);

} // namespace slod::report
