// SPDX-License-Identifier: MIT
// Mutations of rule files by tokens, which get much further into the grammar than those by bytes.
//
//   fuzz_parse_tokens CORPUS [MUTATIONS [SEED]]   SEED 0: a fresh one
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz/parse_checks.h"
#include "syntax/scanner.h"

using namespace gmsim;

namespace {

using Words = std::vector<std::string>;

/// The tokens of a text as they are spelt.
Words words_of(const std::string& text) {
  const syntax::Scanner scanner(support::FileId{}, text,
                                [](const support::Diagnostic&) { return true; });
  Words words;
  for (const syntax::Token& token : scanner.tokens())
    if (token.begin < token.end) words.push_back(text.substr(token.begin, token.end - token.begin));
  return words;
}

class TokenMutator {
 public:
  TokenMutator(std::vector<Words> corpus, std::uint64_t seed)
      : corpus_(std::move(corpus)), random_(seed) {
    for (const Words& words : corpus_)
      vocabulary_.insert(vocabulary_.end(), words.begin(), words.end());
    std::sort(vocabulary_.begin(), vocabulary_.end());
    vocabulary_.erase(std::unique(vocabulary_.begin(), vocabulary_.end()), vocabulary_.end());
  }

  std::string next() {
    Words words = any(corpus_);
    const std::size_t changes = 1 + below(6);
    for (std::size_t i = 0; i < changes; ++i) change(words);
    std::string text;
    for (const std::string& word : words) text += word + (below(8) == 0 ? "\n" : " ");
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return random_() % end; }
  template <class T>
  const T& any(const std::vector<T>& list) {
    return list[below(list.size())];
  }

  void change(Words& words) {
    if (words.empty()) words.push_back(any(vocabulary_));
    const std::size_t at = below(words.size());
    const auto place = words.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(6)) {
      case 0:
        words.erase(place);
        break;
      case 1:
        words.insert(place, any(vocabulary_));
        break;
      case 2:
        *place = any(vocabulary_);
        break;
      case 3:
        std::swap(*place, words[below(words.size())]);
        break;
      case 4:
        insert_piece(words, at, any(corpus_));
        break;
      case 5:
        insert_piece(words, at, Words(words));
        break;
    }
  }

  void insert_piece(Words& words, std::size_t at, const Words& source) {
    if (source.empty()) return;
    const std::size_t begin = below(source.size());
    const std::size_t count = std::min(1 + below(12), source.size() - begin);
    const auto first = source.begin() + static_cast<std::ptrdiff_t>(begin);
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), first,
                 first + static_cast<std::ptrdiff_t>(count));
  }

  std::vector<Words> corpus_;
  Words vocabulary_;
  std::mt19937_64 random_;
};

std::vector<Words> load(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Words> corpus;
  for (const auto& path : files) {
    std::ifstream in(path, std::ios::binary);
    corpus.push_back(words_of(std::string(std::istreambuf_iterator<char>(in), {})));
  }
  return corpus;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: %s CORPUS [MUTATIONS [SEED]]\n", arguments[0]);
    return 2;
  }
  const std::size_t mutations = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 1000;
  std::uint64_t seed = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 1;
  if (seed == 0) seed = std::random_device{}();
  TokenMutator mutator(load(arguments[1]), seed);
  std::printf("%zu mutations, seed %llu\n", mutations, static_cast<unsigned long long>(seed));
  for (std::size_t i = 0; i < mutations; ++i) fuzz::check_parsing(mutator.next());
  return 0;
}
