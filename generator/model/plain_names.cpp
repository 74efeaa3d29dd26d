// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/plain_names.hpp"

#include "model/families.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>

namespace lagen {

namespace {

/// Hands out words, each once.
class WordList {
  public:
    WordList(const std::vector<std::string>& names, const std::vector<std::string>& known)
    {
        for (const auto* list : {&names, &known})
            std::ranges::copy_if(*list, std::inserter(words_, words_.end()),
                                 [](const std::string& name) { return plain_name(name) == name; });
        for (const std::string& name : known)
            if (!words_.contains(name) && !given_.contains(name)) given_.emplace(name, fresh(plain_name(name)));
    }

    std::string take(const std::string& name)
    {
        const auto known = given_.find(name);
        const std::string word = words_.contains(name) ? name : known != given_.end() ? known->second : "";
        if (!word.empty() && used_.insert(word).second) return word;
        return fresh(plain_name(name));
    }

  private:
    std::string fresh(const std::string& plain)
    {
        std::string word = plain;
        for (int k = 2; words_.contains(word) || !given_words_.insert(word).second; ++k)
            word = plain + '_' + std::to_string(k);
        return word;
    }

    std::set<std::string> words_;              ///< names that are words
    std::set<std::string> given_words_;        ///< words of others
    std::set<std::string> used_;               ///< words of columns
    std::map<std::string, std::string> given_; ///< known names that are no words
};

} // namespace

std::string plain_name(const std::string& name)
{
    std::string plain;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool letter = byte >= 0x80 || c == '_' || std::isalnum(byte) != 0;
        if (letter || (!plain.empty() && plain.back() != '_')) plain += letter ? c : '_';
    }
    if (!plain.empty() && plain.back() == '_' && !name.ends_with('_')) plain.pop_back();
    if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain[0])) != 0) plain.insert(0, "_");
    return plain;
}

std::vector<std::string> plain_names(const std::vector<std::string>& names, const std::vector<std::string>& known)
{
    WordList list(names, known);
    std::vector<std::string> words;
    for (const std::string& name : names) words.push_back(list.take(name));
    return words;
}

std::optional<std::size_t> find_plain(const std::vector<std::string>& names, const std::string& word,
                                      const std::vector<std::string>& known)
{
    const auto place_in = [&](const std::vector<std::string>& list) -> std::optional<std::size_t> {
        const auto found = std::ranges::find(list, word);
        return found == list.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - list.begin()));
    };
    const std::optional<std::size_t> exact = place_in(names);
    return exact ? exact : place_in(plain_names(names, known));
}

std::vector<std::string> all_names(const Model& model)
{
    std::vector<std::string> names = symbol_names(model);
    for (const Symbol& symbol : model.fibre.momenta) names.push_back(symbol.name);
    for (const NamedTree& observable : model.observables) names.push_back(observable.name);
    // Definitions, and what else a column may be, where its name is the word of one of these.
    for (std::size_t k = 0, count = names.size(); k < count; ++k)
        if (const std::string word = plain_name(names[k]);
            word != names[k] && (model.columns.has_definition(word) || model.columns.has_symbol(word)))
            names.push_back(word);
    return names;
}

} // namespace lagen
