// SPDX-License-Identifier: MIT
// The runner must be able to fail: each way in which a case can be wrong is noticed.
#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "golden/diagnostic_coverage.h"
#include "golden/golden_run.h"
#include "support/diagnostic.h"

using namespace gmsim::golden;
namespace fs = std::filesystem;

namespace {

/// A folder of golden files for one test.
class Folder {
 public:
  Folder() : root_(fs::temp_directory_path() / ("gmsim-runner-" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    fs::create_directories(root_ / "area" / "input");
  }
  ~Folder() { fs::remove_all(root_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  Case write(const std::string& name, const std::string& text = "") const {
    std::ofstream(root_ / name) << text;
    return {root_ / name};
  }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(root_ / name); }
  [[nodiscard]] const fs::path& root() const { return root_; }

 private:
  fs::path root_;
};

/// Prints its arguments; `err TEXT` prints TEXT as an error and fails, `crash` throws.
int stand_in(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  if (arguments[0] == "crash") throw std::runtime_error("bug");
  if (arguments[0] == "err") {
    err << arguments[1] << '\n';
    return 2;
  }
  for (const std::string& argument : arguments) out << '[' << argument << ']';
  out << '\n';
  return 0;
}

bool passes(const Case& which, Mode mode = Mode::Compare) {
  std::ostringstream report;
  return run_case(which, stand_in, mode, report);
}

}  // namespace

TEST_CASE("cases are the files of the areas, not of folders below") {
  const Folder folder;
  folder.write("README.md");
  folder.write("area/b.rule");
  folder.write("area/a.cmd");
  folder.write("area/input/used.rule");
  const std::vector<Case> cases = find_cases(folder.root(), {});
  REQUIRE(cases.size() == 2);
  CHECK(cases[0].name() == "a");
  CHECK(find_cases(folder.root(), {"area/b"}).size() == 1);
  CHECK(find_cases(folder.root(), {"area"}).size() == 2);
  CHECK(find_cases(folder.root(), {"elsewhere"}).empty());
}

TEST_CASE("arguments may be quoted") {
  CHECK(split_arguments("  check a\tb  ") == std::vector<std::string>{"check", "a", "b"});
  CHECK(split_arguments("--where \"x > '0'\" '' p=\"1 m\"") ==
        std::vector<std::string>{"--where", "x > '0'", "", "p=1 m"});
}

TEST_CASE("a rule file is checked unless its first line says what to do") {
  const Case which{"tests/golden/area/x.rule"};
  using Lines = std::vector<std::vector<std::string>>;
  CHECK(command_lines(which, "rule r() {}", "/t") == Lines{{"check", "tests/golden/area/x.rule"}});
  CHECK(command_lines(which, "// args: --dump ast %s\n", "/t") ==
        Lines{{"--dump", "ast", "tests/golden/area/x.rule"}});
  CHECK(command_lines({"area/x.cmd"}, "# comment\n\nlist\nrun %d/a -o %t/b\n", "/t") ==
        Lines{{"list"}, {"run", "area/a", "-o", "/t/b"}});
}

TEST_CASE("the expected output passes and any other fails") {
  const Folder folder;
  const Case which = folder.write("area/x.cmd", "one\ntwo %t/f\n");
  CHECK_FALSE(passes(which));
  folder.write("area/x.out", "[one]\n[two][%t/f]\n");
  CHECK(passes(which));
  folder.write("area/x.out", "[one]\n[two][%t/g]\n");
  CHECK_FALSE(passes(which));
  folder.write("area/x.out", "[one]\n[two][%t/f]");
  CHECK_FALSE(passes(which));
}

TEST_CASE("the name says whether the case fails") {
  const Folder folder;
  folder.write("area/x.err", "why\n");
  folder.write("area/fail_x.err", "why\n");
  CHECK_FALSE(passes(folder.write("area/x.cmd", "err why\n")));
  CHECK(passes(folder.write("area/fail_x.cmd", "err why\n")));
  CHECK_FALSE(passes(folder.write("area/fail_y.cmd", "")));
}

TEST_CASE("a crash is never an expected failure") {
  const Folder folder;
  folder.write("area/fail_x.err", "exception: bug\n");
  CHECK_FALSE(passes(folder.write("area/fail_x.cmd", "crash\n")));
}

TEST_CASE("an update writes what is printed and removes what is not") {
  const Folder folder;
  const Case which = folder.write("area/x.cmd", "one\n");
  folder.write("area/x.err", "old\n");
  CHECK(passes(which, Mode::Update));
  CHECK(passes(which));
  CHECK(folder.has("area/x.out"));
  CHECK_FALSE(folder.has("area/x.err"));
}

TEST_CASE("expectations without a case are found") {
  const Folder folder;
  folder.write("area/x.cmd");
  folder.write("area/x.out");
  folder.write("area/gone.err");
  CHECK(find_orphans(folder.root()) == std::vector<fs::path>{folder.root() / "area/gone.err"});
}

TEST_CASE("coverage wants each kind once: in an expectation or among the exceptions") {
  const Folder folder;
  std::string expected;
  for (const auto& row : gmsim::support::diagnostic_kinds())
    if (row.name != "usage") expected += "error: m [" + std::string(row.name) + "]\n";
  const auto covered = [&] {
    std::ostringstream report;
    return check_coverage(folder.root(), report);
  };
  folder.write("area/fail_all.err", expected);
  CHECK_FALSE(covered());
  folder.write("uncovered_kinds.txt", "# comment\nusage  because\n");
  CHECK(covered());
  folder.write("uncovered_kinds.txt", "usage\n");
  CHECK_FALSE(covered());
  folder.write("uncovered_kinds.txt", "usage  because\nusgae  because\n");
  CHECK_FALSE(covered());
  folder.write("uncovered_kinds.txt", "usage  because\nsyntax  because\n");
  CHECK_FALSE(covered());
}
