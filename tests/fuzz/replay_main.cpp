// SPDX-License-Identifier: MIT
// Stands in for libFuzzer: runs every file of a corpus folder, its truncations and seeded mutations
// of it through LLVMFuzzerTestOneInput.
//
//   fuzz_NAME CORPUS [MUTATIONS [SEED]]   MUTATIONS in all (default 1000); SEED 0: a fresh one
//   fuzz_NAME FILE                        that file alone
//
// On a crash, a failed allocation or an input that takes longer than kSecondsPerInput the input is
// written to crash-SEED.input in the current folder.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace {

constexpr unsigned kSecondsPerInput = 60;
constexpr std::size_t kLongestTruncated = 4096;
constexpr rlim_t kMemory = rlim_t{2} << 30;

using Bytes = std::vector<std::uint8_t>;

// Read by the signal handlers, which have no other way to the input.
const Bytes* current_input = nullptr;
std::string crash_file;

void save_input() {
  const int file = open(crash_file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
  if (file < 0 || current_input == nullptr) return;
  const ssize_t written = write(file, current_input->data(), current_input->size());
  std::fprintf(stderr, "the input is in %s (%zd bytes)\n", crash_file.c_str(), written);
}

void on_signal(int number) {
  save_input();
  signal(number, SIG_DFL);
  raise(number);
}

void run(const Bytes& input) {
  current_input = &input;
  alarm(kSecondsPerInput);
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

Bytes read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

/// Small changes of the kinds that break readers.
class Mutator {
 public:
  Mutator(const std::vector<Bytes>& corpus, std::uint64_t seed) : corpus_(corpus), random_(seed) {}

  Bytes next() {
    Bytes input = corpus_[below(corpus_.size())];
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes; ++i) change(input);
    return input;
  }

 private:
  std::size_t below(std::size_t end) { return random_() % end; }

  void change(Bytes& input) {
    if (input.empty()) input.push_back(0);
    const std::size_t at = below(input.size());
    switch (below(8)) {
      case 0:
        input[at] = static_cast<std::uint8_t>(below(256));
        break;
      case 1:
        input[at] ^= static_cast<std::uint8_t>(1u << below(8));
        break;
      case 2:
        input.resize(at);
        break;
      case 3:
        erase(input, at, 1 + below(16));
        break;
      case 4:
        copy_from(input, input, at);
        break;
      case 5:
        copy_from(corpus_[below(corpus_.size())], input, at);
        break;
      case 6:
        replace_number(input, at);
        break;
      case 7:
        swap_words(input, at);
        break;
    }
  }

  void erase(Bytes& input, std::size_t at, std::size_t count) {
    const auto begin = input.begin() + static_cast<std::ptrdiff_t>(at);
    input.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(count, input.size() - at)));
  }

  void insert(Bytes& input, std::size_t at, const Bytes& piece) {
    input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), piece.begin(), piece.end());
  }

  void copy_from(const Bytes& source, Bytes& input, std::size_t at) {
    if (source.empty()) return;
    const std::size_t begin = below(source.size());
    const std::size_t count = std::min(1 + below(64), source.size() - begin);
    const auto first = source.begin() + static_cast<std::ptrdiff_t>(begin);
    insert(input, at, Bytes(first, first + static_cast<std::ptrdiff_t>(count)));
  }

  /// The digits at or behind a place become a number at the edge of some type.
  void replace_number(Bytes& input, std::size_t at) {
    static const std::vector<std::string> kNumbers = {"0",
                                                      "-1",
                                                      "1",
                                                      "255",
                                                      "65536",
                                                      "2147483647",
                                                      "2147483648",
                                                      "-2147483648",
                                                      "4294967295",
                                                      "4294967296",
                                                      "9223372036854775807",
                                                      "18446744073709551615",
                                                      "1e308",
                                                      "1e999",
                                                      "nan",
                                                      "-0.0",
                                                      "99999999999999999999999999"};
    const auto is_digit = [](std::uint8_t c) { return c >= '0' && c <= '9'; };
    while (at < input.size() && !is_digit(input[at])) ++at;
    std::size_t end = at;
    while (end < input.size() && is_digit(input[end])) ++end;
    erase(input, at, end - at);
    const std::string& number = kNumbers[below(kNumbers.size())];
    insert(input, at, Bytes(number.begin(), number.end()));
  }

  /// Exchanges two stretches of equal length.
  void swap_words(Bytes& input, std::size_t at) {
    const std::size_t other = below(input.size());
    const std::size_t count = std::min({1 + below(8), input.size() - at, input.size() - other});
    for (std::size_t i = 0; i < count; ++i) std::swap(input[at + i], input[other + i]);
  }

  const std::vector<Bytes>& corpus_;
  std::mt19937_64 random_;
};

void prepare_process() {
  for (int number : {SIGALRM, SIGABRT, SIGTRAP, SIGILL}) signal(number, on_signal);
  if (__sanitizer_set_death_callback != nullptr) {
    __sanitizer_set_death_callback(save_input);
    return;  // the sanitizers reserve address space, and limit allocations by an option of theirs
  }
  for (int number : {SIGSEGV, SIGBUS, SIGFPE}) signal(number, on_signal);
  const rlimit limit{kMemory, kMemory};
  setrlimit(RLIMIT_AS, &limit);
}

std::vector<Bytes> load(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return {read_file(path)};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  for (const auto& file : files) corpus.push_back(read_file(file));
  return corpus;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: %s CORPUS|FILE [MUTATIONS [SEED]]\n", arguments[0]);
    return 2;
  }
  const bool folder = std::filesystem::is_directory(arguments[1]);
  const std::size_t mutations = !folder     ? 0
                                : count > 2 ? std::strtoull(arguments[2], nullptr, 10)
                                            : 1000;
  std::uint64_t seed = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 1;
  if (seed == 0) seed = std::random_device{}();
  crash_file = "crash-" + std::to_string(seed) + ".input";
  prepare_process();

  const std::vector<Bytes> corpus = load(arguments[1]);
  if (corpus.empty()) {
    std::fprintf(stderr, "no files in %s\n", arguments[1]);
    return 2;
  }
  std::printf("%zu files, %zu mutations, seed %llu\n", corpus.size(), mutations,
              static_cast<unsigned long long>(seed));
  for (const Bytes& input : corpus) {
    run(input);
    if (!folder || input.size() > kLongestTruncated) continue;
    for (std::size_t length = 0; length < input.size(); ++length) {
      const Bytes shorter(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(length));
      run(shorter);
    }
  }
  Mutator mutator(corpus, seed);
  for (std::size_t i = 0; i < mutations; ++i) {
    const Bytes input = mutator.next();
    run(input);
  }
  alarm(0);
  return 0;
}
