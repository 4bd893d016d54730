#include "support/allocation_counter.hpp"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

// Every form that may be called is defined: the library's own forms for arrays and without exceptions call
// the plain ones, but those of AddressSanitizer, which it would take in their place, do not.
namespace {

std::atomic<std::uint64_t> calls{0}, held{0};

void* counted(void* memory)
{
    ++calls;
    held += malloc_usable_size(memory);
    return memory;
}

void give_back(void* memory) noexcept
{
    held -= malloc_usable_size(memory);
    std::free(memory);
}

void* take(std::size_t size) noexcept
{
    return counted(std::malloc(size));
}

void* take(std::size_t size, std::align_val_t alignment) noexcept
{
    const auto step = std::size_t(alignment);
    return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}

void* or_throw(void* memory)
{
    if (memory == nullptr)
        throw std::bad_alloc();
    return memory;
}

} // namespace

std::uint64_t slod::test::allocations()
{
    return calls;
}

std::uint64_t slod::test::bytes_held()
{
    return held;
}

void* operator new(std::size_t size)
{
    return or_throw(take(size));
}

void* operator new[](std::size_t size)
{
    return or_throw(take(size));
}

void* operator new(std::size_t size, std::align_val_t alignment)
{
    return or_throw(take(size, alignment));
}

void* operator new[](std::size_t size, std::align_val_t alignment)
{
    return or_throw(take(size, alignment));
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
    return take(size);
}

void* operator new[](std::size_t size, const std::nothrow_t&) noexcept
{
    return take(size);
}

void operator delete(void* memory) noexcept
{
    give_back(memory);
}

void operator delete[](void* memory) noexcept
{
    give_back(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
    give_back(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
    give_back(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
    give_back(memory);
}

void operator delete[](void* memory, std::align_val_t) noexcept
{
    give_back(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    give_back(memory);
}

void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
    give_back(memory);
}

void operator delete(void* memory, const std::nothrow_t&) noexcept
{
    give_back(memory);
}

void operator delete[](void* memory, const std::nothrow_t&) noexcept
{
    give_back(memory);
}
