// SPDX-License-Identifier: MIT
/// Work by several threads on pieces that begin and end in their order.
#pragma once

#include "lagen/requirements.hpp"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lagen::detail {

/// `begin(piece)` fills the next piece, or answers false: there are no more. `work(source)` is what several threads do
/// at once: source.next(..) answers a piece to work on, source.done(*piece) gives it back; a thread may have several.
/// `deliver(piece)` gets the pieces in the order in which they were begun. Of `begin` one call runs at a time, of
/// `deliver` too. So many pieces exist as `slots`; they are used again and again.
template <class Piece, class Begin, class Work, class Deliver>
class InOrder {
  public:
    InOrder(std::size_t slots, Begin& begin, Work& work, Deliver& deliver)
        : slots_(slots), begin_(begin), work_(work), deliver_(deliver)
    {
    }

    /// By `threads` threads, the caller among them; fewer where the machine has no room for more. What a call throws
    /// ends the work and is thrown here, when all threads have ended.
    void run(std::size_t threads)
    {
        std::vector<std::thread> others;
        try {
            for (std::size_t k = 1; k < threads; ++k) others.emplace_back([this] { work_on(); });
        } catch (...) {
            // std::system_error or std::bad_alloc: those that are there do it all.
        }
        work_on();
        for (std::thread& other : others) other.join();
        if (failure_) std::rethrow_exception(failure_);
    }

    /// A piece that was begun. nullptr at the end, and where there is none now: a thread with pieces in its hands must
    /// not `wait` for a slot, which may be theirs.
    Piece* next(bool wait)
    {
        std::unique_lock source(source_mutex_, std::defer_lock);
        if (wait)
            source.lock();
        else if (!source.try_lock())
            return nullptr;
        {
            std::unique_lock lock(mutex_);
            const auto ready = [this] { return stopped_ || begun_ - delivered_ < slots_.size(); };
            if (wait) room_.wait(lock, ready);
            if (stopped_ || !ready()) return nullptr;
        }
        Slot& slot = slots_[begun_ % slots_.size()];
        if (!begin_(slot)) {
            const std::lock_guard lock(mutex_);
            stopped_ = true;
            return nullptr;
        }
        ++begun_;
        return &slot;
    }

    void done(Piece& piece)
    {
        const std::lock_guard delivery(delivery_mutex_);
        static_cast<Slot&>(piece).is_done = true;
        for (Slot* first = &slots_[delivered_ % slots_.size()]; first->is_done;
             first = &slots_[delivered_ % slots_.size()]) {
            first->is_done = false; // once, also where this throws
            deliver_(*first);
            const std::lock_guard lock(mutex_);
            ++delivered_;
            room_.notify_all();
        }
    }

  private:
    struct Slot : Piece {
        bool is_done = false;
    };

    void work_on() noexcept
    {
        try {
            work_(*this);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
            stopped_ = true;
            room_.notify_all();
        }
    }

    std::vector<Slot> slots_;
    Begin& begin_;
    Work& work_;
    Deliver& deliver_;
    std::mutex source_mutex_, delivery_mutex_;
    std::mutex
        mutex_; ///< of what follows; `begun_` is written under source_mutex_, `delivered_` under delivery_mutex_ too
    std::condition_variable room_;
    std::size_t begun_ = 0, delivered_ = 0;
    bool stopped_ = false;
    std::exception_ptr failure_;
};

/// `threads`, or where that is 0 as many as the machine gives this process.
[[nodiscard]] inline std::size_t thread_count(std::size_t threads) noexcept
{
    if (threads != 0) return threads;
    const unsigned found = std::thread::hardware_concurrency();
    return found == 0 ? 1 : found;
}

} // namespace lagen::detail
