// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/simplify/passes.hpp"

#include "text/comma_list.hpp"

namespace lagen {
namespace {

/// Pairs of terms that stand in one sum of a form: the passes that look for shared ones take about a second for so
/// many. Forms with more are left out, but for the nested one, whose sums are short.
constexpr std::size_t largest_pairs = 20'000;

/// Beyond this many nodes only the nested form is made.
constexpr std::size_t largest_flattened_graph = 5'000;

std::size_t pairs_of(const Form& form)
{
    std::size_t pairs = 0;
    for (const Place& place : live_places(form)) {
        const std::size_t terms = at(form, place).size();
        pairs += terms * (terms - std::min<std::size_t>(terms, 1)) / 2;
    }
    return pairs;
}

template <ExpansionMode expansion>
void read(Work& work)
{
    work.form = collect(work.graph, work.outputs, expansion);
    if (expansion != ExpansionMode::nested && pairs_of(*work.form) > largest_pairs) throw FormRefused{};
}

template <auto rewrite>
void rewrite_form(Work& work)
{
    static_cast<void>(rewrite(*work.form));
}

bool is_short(const Work& work)
{
    return reachable(work.graph, work.outputs).size() <= largest_flattened_graph;
}

bool has_sums_of_angles(const Work& work)
{
    return add_angles(work.graph, work.outputs) != work.outputs;
}

void write_sums_of_angles(Work& work)
{
    work.outputs = add_angles(work.graph, work.outputs);
}

bool has_common_row_factors(const Work& work)
{
    Form form = *work.form;
    return divide_rows(form) > 0;
}

/// The form stays as it is where it is too large to look for terms that cancel.
void cancel(Work& work)
{
    try {
        Form shorter = *work.form;
        cancel_terms(shorter);
        work.form = std::move(shorter);
    } catch (const FormRefused&) {
    }
}

constexpr auto every = in_every_strategy;

/// In the order in which they run.
constexpr Pass table[] = {
    {"angles added", WorksOn::nodes, angles_added, has_sums_of_angles, write_sums_of_angles},
    {"nested", WorksOn::nodes, nested, nullptr, read<ExpansionMode::nested>},
    {"flattened", WorksOn::nodes, flattened, is_short, read<ExpansionMode::none>},
    {"monomials expanded", WorksOn::nodes, monomials_expanded, is_short, read<ExpansionMode::monomials>},
    {"expanded", WorksOn::nodes, expanded, is_short, read<ExpansionMode::all>},
    {"terms cancelled", WorksOn::polynomials, every, nullptr, cancel},
    {"rows divided", WorksOn::systems, rows_divided, has_common_row_factors, rewrite_form<divide_rows>},
    {"shared", WorksOn::polynomials, terms_shared, nullptr, rewrite_form<share_term_pairs>},
    {"factored", WorksOn::polynomials, factored, nullptr, rewrite_form<draw_out_factors>},
    {"factor pairs shared", WorksOn::polynomials, every, nullptr, rewrite_form<share_factor_pairs>},
    {"term pairs shared", WorksOn::polynomials, every, nullptr, rewrite_form<share_term_pairs>},
    {"reciprocals shared", WorksOn::polynomials, every, nullptr, rewrite_form<share_reciprocals>},
    {"single products put back", WorksOn::polynomials, every, nullptr, rewrite_form<inline_single_products>},
    {"signs absorbed", WorksOn::polynomials, every, nullptr, rewrite_form<absorb_signs>},
};

/// Of the 36 that the choices make, those without which an output of the models, the reference sets or the chains of 2
/// to 16 links weighs 3 % more.
constexpr Choices choices[] = {
    flattened | terms_shared | factored,
    flattened,
    monomials_expanded | factored,
    monomials_expanded,
    expanded | factored,
    expanded | rows_divided | factored,
    expanded | terms_shared | factored,
    nested | factored,
    nested,
    angles_added | flattened,
};

} // namespace

std::span<const Pass> passes()
{
    return table;
}

std::span<const Choices> strategies()
{
    return choices;
}

std::string name_of(Choices strategy)
{
    return comma_list(table, [&](const Pass& pass) { return (pass.choice & strategy) != 0 ? pass.name : ""; });
}

} // namespace lagen
