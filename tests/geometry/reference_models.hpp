// SPDX-License-Identifier: GPL-2.0-or-later
/// The six discrete reference cases as model files, and what of a case is compared.
#pragma once

#include "support/json.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lagen {

/// The coordinates of an arrow by name, and its momenta F^-L.
struct ReferenceArrow {
    std::map<std::string, long double> coordinates;
    std::vector<long double> momenta;
};

struct DiscreteCase {
    std::string name; ///< of the file in tests/data/discrete
    std::string model;
    std::function<ReferenceArrow(const json::Value& step, const json::Value& parameters)> arrow;
};

[[nodiscard]] const std::vector<DiscreteCase>& discrete_cases();

/// tests/data/discrete/NAME.json
[[nodiscard]] json::Value read_discrete_case(const std::string& name);

} // namespace lagen
