// SPDX-License-Identifier: MIT
/// Lanes of the state that moved and never exceeded the absolute tolerance of their run: a step that is as accurate as
/// its tolerances asks for no digit of them.
#pragma once

#include <cmath>

namespace lagen::detail {

/// `State` is a column of doubles, whose size may be known at run time; memory is taken with the first state.
template <class State>
class SmallLanes {
  public:
    /// 0: the method has no absolute tolerance, and no lane is below it.
    explicit SmallLanes(double absolute = 0) : absolute_(absolute), open_(absolute > 0) {}

    /// The next accepted state; the first one is the start. Costs one comparison once every lane was larger.
    void see(const State& s)
    {
        if (!open_) return;
        if (!begun_) return begin(s);
        bool open = false;
        for (decltype(s.size()) i = 0; i < s.size(); ++i) {
            if (s[i] != start_[i]) moved_[i] = 1;
            if (!(std::abs(s[i]) <= most_[i])) most_[i] = std::abs(s[i]);
            open = open || most_[i] <= absolute_;
        }
        open_ = open;
    }

    [[nodiscard]] bool is_small(decltype(State().size()) lane) const
    {
        return open_ && begun_ && moved_[lane] != 0 && most_[lane] <= absolute_;
    }
    [[nodiscard]] double most(decltype(State().size()) lane) const { return most_[lane]; }
    [[nodiscard]] auto size() const { return begun_ ? start_.size() : 0; }

  private:
    void begin(const State& s)
    {
        begun_ = true;
        start_ = moved_ = most_ = s;
        for (decltype(s.size()) i = 0; i < s.size(); ++i) moved_[i] = 0, most_[i] = std::abs(s[i]);
    }

    double absolute_;
    bool open_, begun_ = false; ///< `open_`: some lane has not exceeded it
    State start_, moved_, most_;
};

} // namespace lagen::detail
