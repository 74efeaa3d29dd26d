// SPDX-License-Identifier: GPL-2.0-or-later
/// Certified values and first derivatives of formulas at a point: balls (Arb) of 420 bits, carried forward. The truth
/// of every near miss rests on them; nothing of the generator is used.
#pragma once

#include "formula.hpp"

#include <arb.h>

namespace lagen::laws {

inline constexpr slong ball_precision = 420;

/// A real number within a rigorous error bound, or "not finite" where a formula is undefined.
class Ball {
  public:
    Ball() { arb_init(ball_); }
    explicit Ball(const mpq_class& value);
    Ball(const Ball& other) : Ball() { arb_set(ball_, other.ball_); }
    Ball(Ball&& other) noexcept : Ball() { arb_swap(ball_, other.ball_); }
    Ball& operator=(Ball other) noexcept
    {
        arb_swap(ball_, other.ball_);
        return *this;
    }
    ~Ball() { arb_clear(ball_); }

    [[nodiscard]] arb_ptr get() { return ball_; }
    [[nodiscard]] arb_srcptr get() const { return ball_; }
    [[nodiscard]] bool is_finite() const { return arb_is_finite(ball_) != 0; }
    [[nodiscard]] bool excludes_zero() const { return is_finite() && arb_contains_zero(ball_) == 0; }
    [[nodiscard]] bool is_positive() const { return is_finite() && arb_is_positive(ball_) != 0; }
    [[nodiscard]] double middle() const;
    /// An upper bound of |value|.
    [[nodiscard]] double bound() const;

    friend Ball operator+(const Ball& a, const Ball& b);
    friend Ball operator-(const Ball& a, const Ball& b);
    friend Ball operator*(const Ball& a, const Ball& b);
    friend Ball operator/(const Ball& a, const Ball& b);

  private:
    arb_t ball_;
};

using Point = std::map<std::string, Ball>;

/// A value and its partial derivatives along the evaluation's directions.
struct Jet {
    Ball value;
    std::vector<Ball> slope;
};

/// Evaluates formulas at one point, each node once.
class JetEvaluation {
  public:
    /// `directions` are the variables to differentiate along; every variable of a formula must be in `point`.
    JetEvaluation(const Point& point, std::vector<std::string> directions)
        : point_(point), directions_(std::move(directions))
    {
    }
    const Jet& operator()(const Formula& formula);

  private:
    [[nodiscard]] Jet evaluate(const Formula& formula);
    [[nodiscard]] Jet constant(Ball value) const;
    [[nodiscard]] Jet product(const Jet& a, const Jet& b) const;
    [[nodiscard]] Jet chain(Ball value, const Ball& outer, const Jet& inner) const;
    [[nodiscard]] Jet apply(const std::string& function, const Jet& inner) const;

    const Point& point_;
    std::vector<std::string> directions_;
    std::map<std::string, Jet> known_; ///< by text: equal texts are the same formula
};

} // namespace lagen::laws
