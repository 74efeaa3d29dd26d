// SPDX-License-Identifier: GPL-2.0-or-later
/// Calls a fuzz target with every file of the named files and folders: the driver where there is no libFuzzer.
#include "fuzz/harness.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& place)
{
    std::vector<fs::path> files;
    if (!fs::is_directory(place)) return {place};
    for (const auto& entry : fs::directory_iterator(place))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

} // namespace

int main(int count, char** arguments)
{
    std::size_t done = 0;
    for (int k = 1; k < count; ++k) {
        for (const fs::path& file : files_in(arguments[k])) {
            std::ifstream stream(file, std::ios::binary);
            const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
            std::fprintf(stderr, "%s\n", file.c_str()); // the last one shown is the one that failed
            LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
            ++done;
        }
    }
    std::printf("%zu inputs\n", done);
    return done == 0 ? 1 : 0; // a corpus that is not found would pass for ever
}
