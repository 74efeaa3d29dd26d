// SPDX-License-Identifier: MIT
/// What the program behind `lagen run` writes: rows while the run goes on, drifts and the report at its end.
#pragma once

#include "lagen/integrate/run.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lagen::detail {

/// The shortest decimal that reads back as the same number; "nan" and "inf" for what is no finite number.
inline std::string number_text(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The same as a field: nothing for what is no finite number.
inline void append_number(std::string& line, double value)
{
    if (std::isfinite(value)) line += number_text(value);
}

/// A column: state lane or entry of observables().
struct Column {
    bool observable = false;
    Eigen::Index index = 0;
};

/// First value and largest distance from it.
struct Drift {
    std::string key;
    double initial = 0;
    double most = 0;
    bool begun = false;

    void see(double value) noexcept
    {
        if (!begun) initial = value;
        begun = true;
        // A NaN is a drift without bound and must not be forgotten by the next comparison.
        const double distance = std::abs(value - initial);
        if (!(distance <= most)) most = distance;
    }
};

/// The observer of a run: row(t, s) writes, operator() follows what should be constant.
template <class M>
class DriveRecord {
  public:
    using State = typename M::State;

    DriveRecord(const M& model, std::vector<Column> columns, bool binary, std::FILE* out)
        : model_(model), columns_(std::move(columns)), binary_(binary), out_(out)
    {
        if constexpr (HasEnergy<M>)
            drifts_.push_back({"energy"});
        else if constexpr (HasHamiltonian<M>)
            drifts_.push_back({"hamiltonian"});
        if constexpr (requires { M::invariants_names; })
            for (const char* name : M::invariants_names) drifts_.push_back({std::string("invariant:") + name});
    }

    void row(double t, const State& s)
    {
        follow(t, s);
        last_time_ = t;
        write(t, true);
        if constexpr (requires { model_.observables(t, s); }) {
            const auto observables = model_.observables(t, s);
            for (const Column& column : columns_)
                write(column.observable ? observables[column.index] : s[column.index], false);
        } else {
            for (const Column& column : columns_) write(s[column.index], false);
        }
        if (!binary_) std::fputc('\n', out_);
        ++rows_;
    }

    void operator()(double t, const State& s)
    {
        follow(t, s);
        std::size_t next = 0;
        if constexpr (HasEnergy<M>)
            drifts_[next++].see(static_cast<double>(model_.energy(t, s)));
        else if constexpr (HasHamiltonian<M>)
            drifts_[next++].see(static_cast<double>(model_.hamiltonian(t, s)));
        if constexpr (requires { M::invariants_names; }) {
            const auto values = model_.invariants(t, s);
            for (Eigen::Index i = 0; i < values.size(); ++i) drifts_[next++].see(static_cast<double>(values[i]));
        }
        if constexpr (HasConstraints<M>) {
            const auto values = model_.constraints(t, s);
            for (Eigen::Index i = 0; i < values.size(); ++i) {
                const double size = std::abs(static_cast<double>(values[i]));
                if (!(size <= constraint_)) constraint_ = size;
            }
        }
    }

    [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
    /// Of the last row; NaN before the first.
    [[nodiscard]] double last_time() const noexcept { return last_time_; }

    /// The lines of the report that this record knows.
    [[nodiscard]] std::string report() const
    {
        std::string text;
        for (const Drift& drift : drifts_)
            text += drift.key + '=' + number_text(drift.initial) + ',' + number_text(drift.most) + '\n';
        if constexpr (HasConstraints<M>) text += "constraints=" + number_text(constraint_) + '\n';
        return text;
    }

  private:
    /// Rows and steps come in the order of time, so that what the model follows is continuous in the rows. A failure
    /// is the run's affair.
    void follow(double t, const State& s) noexcept
    {
        if constexpr (Follows<M>) static_cast<void>(model_.follow(t, s));
    }

    /// As append_number.
    void write(double value, bool first)
    {
        if (binary_) {
            std::fwrite(&value, sizeof value, 1, out_);
            return;
        }
        if (!first) std::fputc(',', out_);
        if (std::isfinite(value)) std::fputs(number_text(value).c_str(), out_);
    }

    std::conditional_t<Follows<M>, M, const M&> model_; ///< a copy where it learns what it follows
    std::vector<Column> columns_;
    bool binary_;
    std::FILE* out_;
    std::vector<Drift> drifts_;
    double constraint_ = 0;
    std::size_t rows_ = 0;
    double last_time_ = std::numeric_limits<double>::quiet_NaN();
};

} // namespace lagen::detail
