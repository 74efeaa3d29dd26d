// SPDX-License-Identifier: GPL-2.0-or-later
/// Mutations of text by tokens and lines, beside libFuzzer's own by bytes: most of what they make is still nearly an
/// expression or a model, and reaches past the parser.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

namespace {

using Pieces = std::vector<std::string>;

bool is_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Runs of letters and digits, and every other character by itself.
Pieces tokens(const std::string& text)
{
    Pieces pieces;
    for (const char c : text) {
        if (!pieces.empty() && is_word(c) && is_word(pieces.back().back()))
            pieces.back() += c;
        else
            pieces.emplace_back(1, c);
    }
    return pieces;
}

Pieces lines(const std::string& text)
{
    Pieces pieces(1);
    for (const char c : text) {
        pieces.back() += c;
        if (c == '\n') pieces.emplace_back();
    }
    return pieces;
}

/// Drops, doubles, exchanges or copies pieces.
void shuffle(Pieces& pieces, std::minstd_rand& random)
{
    if (pieces.empty()) return;
    const auto any = [&] { return random() % pieces.size(); };
    const auto at = [&](std::size_t k) { return pieces.begin() + static_cast<std::ptrdiff_t>(k); };
    const std::size_t from = any();
    const std::size_t to = any();
    const std::string piece = pieces[from];
    switch (random() % 4) {
    case 0: pieces.erase(at(from)); break;
    case 1: pieces.insert(at(to), piece); break;
    case 2: std::swap(pieces[from], pieces[to]); break;
    default: pieces[to] = piece;
    }
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest, unsigned seed)
{
    std::minstd_rand random(seed);
    if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, largest);
    const std::string text(reinterpret_cast<const char*>(data), size);
    Pieces pieces = random() % 3 == 0 ? lines(text) : tokens(text);
    for (std::size_t k = random() % 3 + 1; k > 0; --k) shuffle(pieces, random);
    std::string changed;
    for (const std::string& piece : pieces) changed += piece;
    changed.resize(std::min(changed.size(), largest));
    std::ranges::copy(changed, data);
    return changed.size();
}
