#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <immintrin.h>

#ifdef SLOD_PLAIN_THREADS
#include "core/plain_threads.hpp"
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#endif

namespace slod {

/// Flushes denormals to zero while it lives, on this thread: every task does, so that a stray 1e-310
/// neither slows a frame nor makes the result depend on which thread met it.
class FlushDenormals {
public:
    FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040U); }
    ~FlushDenormals() { _mm_setcsr(saved_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned saved_;
};

#ifdef SLOD_PLAIN_THREADS

/// The threads that the loops below may use, from when it is made.
class ThreadTeam {
public:
    explicit ThreadTeam(int thread_count)
    {
        PlainThreads::instance().resize(std::size_t(std::max(thread_count, 1)));
    }

    template <class Work>
    void run(const Work& work)
    {
        work();
    }
};

/// Runs body(index) for every index in [0, count), in parallel; returns when all are done.
template <class Body>
void for_each_task(std::size_t count, const Body& body)
{
    std::atomic<std::size_t> next{0};
    // Relaxed, so that the order in which bodies happen to run does not hide from ThreadSanitizer that they
    // might have run at the same time.
    const auto take = [&] { return next.fetch_add(1, std::memory_order_relaxed); };
    const auto drain = [&] {
        const FlushDenormals flush;
        for (std::size_t index = take(); index < count; index = take())
            body(index);
    };
    PlainThreads::instance().run(std::max<std::size_t>(count, 1) - 1, drain);
}

/// Runs both, concurrently; returns when both are done.
template <class First, class Second>
void run_both(const First& first, const Second& second)
{
    for_each_task(2, [&](std::size_t index) { index == 0 ? first() : second(); });
}

#else

/// The threads that the loops below may use; work given to run() uses them all. More threads than
/// cores really exist: without the raised limit TBB would quietly cap them.
class ThreadTeam {
public:
    explicit ThreadTeam(int thread_count)
        : limit_(tbb::global_control::max_allowed_parallelism, std::size_t(std::max(thread_count, 1))),
          arena_(std::max(thread_count, 1))
    {}

    template <class Work>
    void run(const Work& work)
    {
        arena_.execute(work);
    }

private:
    tbb::global_control limit_;
    tbb::task_arena arena_;
};

/// Runs body(index) for every index in [0, count), in parallel; returns when all are done.
template <class Body>
void for_each_task(std::size_t count, const Body& body)
{
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t index) {
        const FlushDenormals flush;
        body(index);
    });
}

/// Runs both, concurrently; returns when both are done.
template <class First, class Second>
void run_both(const First& first, const Second& second)
{
    const auto guarded = [](const auto& work) {
        const FlushDenormals flush;
        work();
    };
    tbb::parallel_invoke([&] { guarded(first); }, [&] { guarded(second); });
}

#endif

/// Blocks of `block` elements that [0, count) is cut into.
constexpr std::size_t block_count(std::size_t count, std::size_t block)
{
    return (count + block - 1) / block;
}

/// Runs body(first, last) over [0, count) in blocks of `block` elements, in parallel; returns when all
/// are done. The cut is fixed, so it, and with it every rounding, is the same for any number of threads.
template <class Body>
void for_each_block(std::size_t count, std::size_t block, const Body& body)
{
    for_each_task(block_count(count, block),
                  [&](std::size_t index) { body(index * block, std::min(count, (index + 1) * block)); });
}

/// Whether body(first, last) is true of all blocks, as for_each_block() cuts them; it is called for each of
/// them, in parallel.
template <class Body>
bool holds_in_blocks(std::size_t count, std::size_t block, const Body& body)
{
    std::atomic<bool> holds{true};
    for_each_block(count, block, [&](std::size_t first, std::size_t last) {
        if (!body(first, last))
            holds = false;
    });
    return holds;
}

} // namespace slod
