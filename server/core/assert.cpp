#include "core/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace slod {

void assertion_failed(const char* claim, const char* file, int line)
{
    std::fprintf(stderr, "%s:%d: broken invariant: %s\n", file, line, claim);
    std::abort();
}

void require_none(const std::vector<std::string>& problems)
{
    for (const std::string& problem : problems)
        std::fprintf(stderr, "broken invariant: %s\n", problem.c_str());
    if (!problems.empty())
        std::abort();
}

} // namespace slod
