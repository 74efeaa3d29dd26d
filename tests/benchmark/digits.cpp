// SPDX-License-Identifier: GPL-2.0-or-later
/// A model by Taylor's method in 113 bits and in 50 digits against a trajectory of 28 digits or more. Compiled by
/// scripts/digits-table with -D MODEL=heavy_top; the header has the kernel `taylor`. Reads words from standard input:
/// the number of parameters, a name and a value each; the names of the state in the order of the columns; the number of
/// rows; a time and the state each, the first row being the start. Prints, for both scalars, the largest error over the
/// rows (max norm of the difference over max norm of the state) and the steps.
#include "model_header.hpp"

#include MODEL_HEADER(MODEL)

#include "lagen/integrate.hpp"
#include "lagen_chart/quad.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <vector>

extern "C" __float128 strtoflt128(const char*, char**);

namespace {

using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;

template <class S>
S number_of(const std::string& text)
{
    if constexpr (std::is_same_v<S, lagen::Quad>)
        return lagen::Quad::of(strtoflt128(text.c_str(), nullptr));
    else
        return S(text.c_str());
}

struct Case {
    std::map<std::string, std::string> parameters;
    std::vector<std::string> names;
    std::vector<std::vector<std::string>> rows;
};

Case read_case(std::size_t dimension)
{
    Case given;
    std::size_t count = 0;
    std::cin >> count;
    for (std::size_t k = 0; k < count; ++k) {
        std::string name;
        std::cin >> name >> given.parameters[name];
    }
    given.names.resize(dimension);
    for (std::string& name : given.names) std::cin >> name;
    std::cin >> count;
    given.rows.assign(count, std::vector<std::string>(1 + dimension));
    for (std::vector<std::string>& row : given.rows)
        for (std::string& word : row) std::cin >> word;
    return given;
}

template <class S>
void measure(const char* label, const Case& given, double tolerance)
{
    using Model = lagen::models::MODEL<S>;
    Model model;
    if constexpr (!Model::parameter_names.empty())
        for (std::size_t k = 0; k < Model::parameter_names.size(); ++k)
            if (const auto found = given.parameters.find(Model::parameter_names[k]); found != given.parameters.end())
                model.parameter(k) = number_of<S>(found->second);
    const auto state_of = [&](const std::vector<std::string>& row) {
        typename Model::State s;
        for (std::size_t i = 0; i < Model::state_names.size(); ++i) {
            const auto column = std::ranges::find(given.names, Model::state_names[i]) - given.names.begin();
            s[static_cast<int>(i)] = number_of<S>(row.at(static_cast<std::size_t>(1 + column)));
        }
        return s;
    };
    lagen::Integrator integrator(model, state_of(given.rows[0]), number_of<S>(given.rows[0][0]),
                                 lagen::Taylor{.tolerance = tolerance});
    S worst(0);
    for (const std::vector<std::string>& row : given.rows) {
        if (const lagen::Status status = integrator.advance_to(number_of<S>(row[0])); status != lagen::Status::ok) {
            std::printf(" %s status %d", label, static_cast<int>(status));
            return;
        }
        const typename Model::State expected = state_of(row);
        S difference(0), size(0);
        for (int i = 0; i < Model::dimension; ++i) {
            const S gap = integrator.state()[i] - expected[i];
            difference = std::max<S>(difference, gap < S(0) ? S(-gap) : gap);
            size = std::max<S>(size, expected[i] < S(0) ? S(-expected[i]) : expected[i]);
        }
        worst = std::max<S>(worst, S(difference / size));
    }
    std::printf(" %s %.1e %zu", label, static_cast<double>(worst), integrator.steps());
}

} // namespace

int main()
{
    const Case given = read_case(lagen::models::MODEL<double>::dimension);
    measure<lagen::Quad>("113 bits", given, 1e-31);
    measure<Digits50>("50 digits", given, 1e-40);
    std::printf("\n");
    return 0;
}
