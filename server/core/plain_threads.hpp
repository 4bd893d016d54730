#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace slod {

/// Threads that wait for loops to help with. They stand in for TBB's where ThreadSanitizer watches: it
/// cannot see into libtbb. Loops may be nested, and may be run by several threads at once. All loops share
/// one mutex: what runs at the same time is seen as such only between two beginnings or ends of loops of
/// several threads.
class PlainThreads {
public:
    /// Those of this process; they end with it.
    static PlainThreads& instance();

    /// How many threads work on one loop at most, with the one that runs it; two, unless told otherwise.
    std::size_t size() const { return size_; }

    /// `size`: at least 1. Not while a loop runs.
    void resize(std::size_t size);

    /// Calls drain() here, and at the same time on at most `helpers` of the waiting threads, though on no
    /// more than size() in all; returns when all of them have returned. Takes no memory. What drain() throws
    /// on a waiting thread ends the program.
    template <class Drain>
    void run(std::size_t helpers, const Drain& drain)
    {
        Loop loop{.drain = [](const void* context) { (*static_cast<const Drain*>(context))(); },
                  .context = &drain,
                  .helpers_wanted = std::min(helpers, size_ - 1)};
        if (loop.helpers_wanted == 0)
            return drain();
        const Opened opened(*this, loop);
        drain();
    }

private:
    /// A loop that someone runs.
    struct Loop {
        void (*drain)(const void* context);
        const void* context;
        std::size_t helpers_wanted;
        std::size_t helpers = 0; ///< threads inside drain(), but for the one that runs the loop
        Loop* opened_before = nullptr;
    };

    /// Offers a loop to the waiting threads while it lives; its end waits for those that took it.
    class Opened {
    public:
        Opened(PlainThreads& threads, Loop& loop);
        ~Opened();
        Opened(const Opened&) = delete;
        Opened& operator=(const Opened&) = delete;

    private:
        PlainThreads& threads_;
        Loop& loop_;
    };

    PlainThreads() { resize(2); }

    /// What each of the waiting threads does.
    void help(const std::stop_token& stop);

    /// Takes the loop off the list, if it is on it.
    void withdraw(const Loop& loop);

    std::size_t size_ = 0;
    std::mutex mutex_;
    std::condition_variable_any opened_;
    std::condition_variable left_;
    Loop* last_opened_ = nullptr; ///< of those that want more helpers
    std::vector<std::jthread> waiting_;
};

} // namespace slod
