#include "scene/nearest.hpp"

#include <algorithm>
#include <numeric>

#include "scene/value_text.hpp"

namespace slod {

std::size_t edit_distance(std::string_view a, std::string_view b)
{
    // Optimal string alignment: row i holds the distances of a's first i letters from b's first j.
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = last;
        std::swap(last, row);
    }
    return last[b.size()];
}

const std::string* nearest(std::string_view name, const std::vector<std::string>& known)
{
    // Longer names are mistyped for anything else.
    constexpr std::size_t longest_name = 64;
    const std::string* best = nullptr;
    std::size_t distance = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (const std::string& candidate : known) {
        if (name.size() > longest_name)
            break;
        const std::size_t candidate_distance = edit_distance(name, candidate);
        if (candidate_distance < distance) {
            distance = candidate_distance;
            best = &candidate;
        }
    }
    return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known)
{
    const std::string* const meant = nearest(name, known);
    return meant != nullptr ? "did you mean " + *meant + "?" : "known are " + joined(known) + ".";
}

} // namespace slod
