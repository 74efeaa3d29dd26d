// SPDX-License-Identifier: GPL-2.0-or-later
/// What a long computation is doing, for a program that shows it: rooms say it, and know of no terminal.
///
///   Stage stage("deciding jacobi", residuals.size());
///   for (const Residual& residual : residuals) { stage.next(); decide(residual); }
#pragma once

#include <atomic>
#include <cstddef>
#include <string>

namespace lagen {

/// Lasts as long as the object. Stages begin and end one inside the other, in one thread.
class Stage {
  public:
    /// `count`: how many of something there are to do; 0 where that is not known.
    explicit Stage(std::string what, std::size_t count = 0);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// The next one begins.
    void next() { ++begun_; }
    /// "deciding jacobi, 12 of 400"
    [[nodiscard]] std::string text() const;

  private:
    std::string what_;
    std::size_t count_;
    std::atomic<std::size_t> begun_ = 0;
};

/// The stages that last, from the outside in: "deciding the model: jacobi, 12 of 400"; "" where none does. From any
/// thread.
[[nodiscard]] std::string stages_text();

} // namespace lagen
