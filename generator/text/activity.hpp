// SPDX-License-Identifier: GPL-2.0-or-later
/// Rooms say here what a long computation is doing, for a program that shows it; they know of no terminal.
///
///   Activity activity("deciding jacobi", residuals.size());
///   for (const Residual& residual : residuals) { activity.next(); decide(residual); }
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <utility>

namespace lagen {

/// Lasts as long as the object. Activities begin and end one inside the other, in one thread.
class Activity {
  public:
    /// `count`: how many of something there are to do; 0 where that is not known.
    explicit Activity(std::string what, std::size_t count = 0);
    ~Activity();
    Activity(const Activity&) = delete;
    Activity& operator=(const Activity&) = delete;

    /// The next one begins.
    void next() { ++begun_; }
    /// "deciding jacobi, 12 of 400"
    [[nodiscard]] std::string text() const;

  private:
    std::string what_;
    std::size_t count_;
    std::atomic<std::size_t> begun_ = 0;
};

/// f(0), .., f(count - 1), each told as it begins.
template <class Each>
void counted(std::string what, std::size_t count, Each each)
{
    Activity activity(std::move(what), count);
    for (std::size_t k = 0; k < count; ++k) {
        activity.next();
        each(k);
    }
}

/// The activities that last, from the outside in: "deciding the model: jacobi, 12 of 400"; "" where none does. From any
/// thread.
[[nodiscard]] std::string activities_text();

} // namespace lagen
