#pragma once

#include <cstdint>

namespace slod::test {

/// Calls of operator new by all threads since the start, counted in programs that link this. What the
/// thread library takes from malloc for its tasks does not count.
std::uint64_t allocations();

/// Bytes that operator new has given to all threads and that have not been given back.
std::uint64_t bytes_held();

} // namespace slod::test
