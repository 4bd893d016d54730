#pragma once

#include <cstddef>

namespace slod {

/// Provides memory for `needed` elements, and for half as many again when it has to be taken from the
/// system at all: for what is called before a phase that must not allocate.
template <class Vector>
void make_room(Vector& vector, std::size_t needed)
{
    if (vector.capacity() < needed)
        vector.reserve(needed + needed / 2);
}

} // namespace slod
