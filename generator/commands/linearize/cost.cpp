// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/linearize/cost.hpp"
#include "commands/line/values.hpp"

#include "commands/scene/scene_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace lagen {

namespace {

using linear::Matrix;

constexpr double weight_tolerance = 1e-12; ///< of the largest entry

/// The parts NAME=expression between semicolons.
std::map<std::string, Excerpt> parts_of_cost(const std::string& text)
{
    const Excerpt whole = whole_text("<--lqr>", text);
    std::map<std::string, Excerpt> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const std::size_t equals = std::min(text.find('=', begin), end);
        const Excerpt name = trimmed(whole, begin, equals);
        if (equals == end || (name.text != "Q" && name.text != "R") || parts.contains(name.text))
            throw UsageError(fmt::format("--lqr needs 'Q=..;R=..', found '{}'", text));
        parts.emplace(name.text, trimmed(whole, equals + 1, end));
        begin = end + 1;
    }
    if (parts.size() < 2) throw UsageError(fmt::format("--lqr needs 'Q=..;R=..', found '{}'", text));
    return parts;
}

/// One of the two in numbers.
class WeightReader {
  public:
    WeightReader(const Model& model, const Values& parameters, const char* name, const Excerpt& text)
        : name_(name), where_(text.range(0, text.text.size())), array_(option_array(model, "lqr", text))
    {
        TreeValues value_of;
        for (const Tree& entry : array_.entries) {
            numbers_.push_back(static_cast<double>(value_of(entry, parameters)));
            if (!std::isfinite(numbers_.back())) fail("has an entry that is no finite number");
        }
    }

    /// Symmetric, with eigenvalues of at least `least` times the largest.
    [[nodiscard]] Matrix read(std::size_t n, double least, const char* definite) const
    {
        const Matrix M = matrix(static_cast<Eigen::Index>(n));
        const double size = M.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < M.rows(); ++i)
            for (Eigen::Index j = 0; j < i; ++j)
                if (std::abs(M(i, j) - M(j, i)) > weight_tolerance * size)
                    fail(fmt::format("is not symmetric: its entry [{0},{1}] is {2:.6g}, and [{1},{0}] is {3:.6g}",
                                     i + 1, j + 1, M(i, j), M(j, i)));
        const double smallest = Eigen::SelfAdjointEigenSolver<Matrix>(M).eigenvalues().minCoeff();
        if (!(smallest >= least * size) || (least > 0 && size == 0))
            fail(fmt::format("is not {}: its least eigenvalue is {:.6g}", definite, smallest));
        return M;
    }

  private:
    [[nodiscard]] Matrix matrix(Eigen::Index n) const
    {
        const Eigen::Map<const Eigen::VectorXd> entries(numbers_.data(), static_cast<Eigen::Index>(numbers_.size()));
        const Shape& shape = array_.shape;
        const auto rows = static_cast<Eigen::Index>(shape.rows), columns = static_cast<Eigen::Index>(shape.columns);
        if (shape.rank == Rank::scalar) return entries[0] * Matrix::Identity(n, n);
        if (shape.rank == Rank::vector && rows == n) return entries.asDiagonal();
        if (shape.rank == Rank::matrix && rows == n && columns == n) return entries.reshaped<Eigen::RowMajor>(n, n);
        fail(fmt::format("is {}, where a number, a vector of {} or a {} x {} matrix is required", to_text(shape), n, n,
                         n));
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw ModelError(fmt::format("{} of --lqr {}", name_, what), where_);
    }

    const char* name_;
    SourceRange where_;
    ArrayValue array_;
    std::vector<double> numbers_;
};

} // namespace

QuadraticCost read_cost(const Options& options, const Model& model, const Values& parameters, std::size_t n,
                        std::size_t m)
{
    const std::map<std::string, Excerpt> parts = parts_of_cost(options.get("lqr"));
    return {WeightReader(model, parameters, "Q", parts.at("Q")).read(n, -weight_tolerance, "positive semidefinite"),
            WeightReader(model, parameters, "R", parts.at("R")).read(m, weight_tolerance, "positive definite")};
}

} // namespace lagen
