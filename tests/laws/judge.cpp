// SPDX-License-Identifier: GPL-2.0-or-later
/// Exceptions, evidence and witnesses of one call of `verify`.
#include "judge.hpp"

#include "model/read_model.hpp"

#include <cctype>
#include <cmath>
#include <ctime>

namespace lagen::laws {
namespace {

/// "|r| < 1e-74 at 3 points" -> "|r| < #e-# at # points", so that equal reasons are counted together; the number of a
/// coordinate goes too.
std::string without_numbers(const std::string& text)
{
    std::string result;
    for (const char letter : text) {
        if (std::isdigit(static_cast<unsigned char>(letter)) == 0)
            result += letter;
        else if (result.empty() || result.back() != '#')
            result += '#';
    }
    return result;
}

/// "3/5", "-2" or "0.125e-3" exactly.
mpq_class exact_number(const std::string& text)
{
    std::string digits = text.substr(0, text.find('e'));
    long exponent = text.find('e') == std::string::npos ? 0 : std::stol(text.substr(text.find('e') + 1));
    const std::size_t point = digits.find('.');
    if (point != std::string::npos) {
        exponent -= static_cast<long>(digits.size() - point - 1);
        digits.erase(point, 1);
    }
    mpq_class value(digits, 10);
    value.canonicalize();
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
    return exponent < 0 ? mpq_class(value / scale) : mpq_class(value * scale);
}

std::string fault_of(const LocalAlgebroid& algebroid, const Check& check)
{
    if (!check.decision.witness) return "refuted without a witness";
    // Where the two orders of a pair disagree, C has no meaning for the other equations.
    if (!algebroid.second_orders.empty() && check.name != "antisymmetry") return "";
    Point point;
    for (const auto& [name, value] : check.decision.witness->whole) point[name] = Ball(exact_number(to_text(value)));
    for (const std::vector<std::string>* names : {&algebroid.base, &algebroid.parameters})
        for (const std::string& name : *names)
            if (!point.contains(name)) return "the witness has no " + name;
    JetEvaluation evaluate(point, {});
    for (const Formula& h : algebroid.constraints)
        if (evaluate(h).value.excludes_zero()) return ""; // rounded: not on the constraint set
    for (const Formula& g : algebroid.positive)
        if (!evaluate(g).value.is_positive()) return "the witness is outside the domain";
    const auto residuals = residuals_at(algebroid, point);
    if (!residuals) return "the model is not defined at the witness";
    for (const PointResidual& residual : *residuals) {
        if (residual.name != check.name || residual.indices.front() != check.indices.front()) continue;
        if (residual.name != "tangency" && residual.indices != check.indices) continue;
        const double found = residual.value.middle(), claimed = check.decision.witness->value;
        if (std::abs(found - claimed) <= 1e-9 * std::abs(found) && residual.value.excludes_zero()) return "";
        if (residual.name != "tangency" || algebroid.constraints.size() == 1)
            return "the residual is " + std::to_string(found) + " at the witness, not " + std::to_string(claimed);
    }
    return "no residual has the name of the check";
}

} // namespace

Answer answer_of(const std::string& text)
{
    Answer answer;
    const std::clock_t begin = std::clock();
    try {
        const ModelReport verified = verify(read_model_text("random.toml", "name = \"random\"\n" + text));
        answer.verdict = to_text(verified.structure.verdict);
        for (const Check& check : verified.structure.checks) {
            if (check.decision.status == ProofStatus::refuted) answer.refuted.push_back(check);
            if (check.decision.status == ProofStatus::undecided && answer.reason.empty())
                answer.reason = check.name + ": " + without_numbers(check.decision.evidence);
        }
        if (answer.reason.empty()) answer.reason = verified.structure.note;
        answer.algebroid = verified.algebroid;
    } catch (const std::exception& error) {
        answer.verdict = std::string("exception: ") + error.what();
    } catch (const InternalError& error) {
        answer.verdict = std::string("exception: ") + error.what();
    }
    answer.milliseconds = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return answer;
}

std::string witness_fault(const LocalAlgebroid& algebroid, const Answer& answer)
{
    for (const Check& check : answer.refuted) {
        std::string fault = fault_of(algebroid, check);
        if (fault.empty()) continue;
        std::string where;
        for (const std::string& index : check.indices) where += (where.empty() ? "" : ", ") + index;
        return check.name + "(" + where + "): " + fault;
    }
    return "";
}

} // namespace lagen::laws
