// SPDX-License-Identifier: GPL-2.0-or-later
/// write_models FOLDER: every case of tests/data/continuous and tests/data/bvp as FOLDER/NAME.toml, for
/// scripts/reference-table.
#include "support/reference_case.hpp"

#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: write_models FOLDER\n";
        return 4;
    }
    std::vector<lagen::ReferenceCase> cases = lagen::read_reference_cases();
    for (lagen::ReferenceCase& problem : lagen::read_control_cases()) cases.push_back(std::move(problem));
    for (const lagen::ReferenceCase& reference : cases) {
        std::ofstream file(std::string(argv[1]) + "/" + reference.name + ".toml");
        file << lagen::model_text(reference);
        if (!file.flush()) {
            std::cerr << "write_models: cannot write " << reference.name << ".toml in " << argv[1] << '\n';
            return 5;
        }
    }
    return 0;
}
