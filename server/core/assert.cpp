#include "core/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace slod {

void assertion_failed(const char* claim, const char* file, int line)
{
    std::fprintf(stderr, "%s:%d: broken invariant: %s\n", file, line, claim);
    std::abort();
}

} // namespace slod
