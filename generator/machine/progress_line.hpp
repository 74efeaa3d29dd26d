// SPDX-License-Identifier: GPL-2.0-or-later
/// How far a long computation is, on standard error: on a terminal one line that is rewritten, after half a second.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace lagen {

class ProgressLine {
  public:
    /// Elsewhere than on a terminal there is a line every `minutes`; without them nothing is said.
    explicit ProgressLine(std::optional<std::chrono::minutes> minutes = {});
    /// Asks for the text where it is time to show one.
    void show(const std::function<std::string()>& text);
    /// Wipes the line.
    void clear();

  private:
    bool terminal_, shown_ = false;
    std::optional<std::chrono::minutes> minutes_;
    std::chrono::steady_clock::time_point next_;
};

} // namespace lagen
