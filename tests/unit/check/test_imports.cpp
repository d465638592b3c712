// SPDX-License-Identifier: MIT
// Files: imports, the library and what takes its place.
#include <doctest/doctest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "check/check.h"

namespace {

namespace fs = std::filesystem;
using gmsim::support::DiagnosticKind;

/// A folder of rule files that is gone after the test.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = fs::temp_directory_path() /
            ("gmsim_imports_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path write(const std::string& name, const std::string& text) const {
    const fs::path path = path_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Run {
  gmsim::support::SourceMap sources;
  gmsim::support::Diagnostics diagnostics;
  gmsim::check::CheckedRules rules;
};

Run run(const std::vector<fs::path>& files, const gmsim::check::LibraryOptions& options) {
  Run result;
  result.rules =
      gmsim::check::check_rules(files, options, result.sources, result.diagnostics);
  return result;
}

Run run_alone(const std::vector<fs::path>& files) {
  gmsim::check::LibraryOptions options;
  options.with_stdlib = false;
  return run(files, options);
}

}  // namespace

TEST_CASE("imports are relative to the importing file and read once") {
  const Folder folder;
  folder.write("base.rule", "function one(a) = 1;");
  folder.write("deep/left.rule", "import \"../base.rule\"; function left(a) = one(a);");
  folder.write("right.rule", "import \"base.rule\"; function right(a) = one(a);");
  const auto main = folder.write("main.rule",
                                 "import \"deep/left.rule\"; import \"right.rule\";"
                                 "rule r(a) { left { a; } where left(a) == right(a); }");
  const Run checked = run_alone({main});
  CHECK(checked.diagnostics.all().empty());
  CHECK(checked.rules.files().size() == 4);
  CHECK(checked.rules.in(2).find_rule("r") != nullptr);
}

TEST_CASE("a file that is not there comes with the name of one that is") {
  const Folder folder;
  folder.write("wind.rule", "");
  const auto main = folder.write("main.rule", "import \"wnd.rule\";");
  const Run checked = run_alone({main});
  REQUIRE(checked.diagnostics.all().size() == 1);
  const auto& diagnostic = checked.diagnostics.all()[0];
  CHECK(diagnostic.kind == DiagnosticKind::ImportNotFound);
  CHECK(diagnostic.help == "did you mean `wind.rule`?");
  CHECK(checked.sources.text(*diagnostic.place) == "\"wnd.rule\"");

  const Run missing = run_alone({folder.path() / "maim.rule"});
  REQUIRE(missing.diagnostics.all().size() == 1);
  CHECK(missing.diagnostics.all()[0].kind == DiagnosticKind::FileError);
  CHECK(missing.diagnostics.all()[0].help == "did you mean `main.rule`?");
}

TEST_CASE("a circle of imports is reported at the import that closes it") {
  const Folder folder;
  const auto a = folder.write("a.rule", "import \"b.rule\";");
  folder.write("b.rule", "import \"a.rule\";");
  const Run checked = run_alone({a});
  REQUIRE(checked.diagnostics.all().size() == 1);
  CHECK(checked.diagnostics.all()[0].kind == DiagnosticKind::ImportCycle);
  CHECK(checked.sources.text(*checked.diagnostics.all()[0].place) == "\"a.rule\"");

  const auto self = folder.write("self.rule", "import \"self.rule\";");
  const Run own = run_alone({self});
  REQUIRE(own.diagnostics.all().size() == 1);
  CHECK(own.diagnostics.all()[0].message == "a file cannot import itself");
}

TEST_CASE("a library comes from a folder, module by module") {
  const Folder folder;
  folder.write("lib/particles.rule", "embedding position : vec3 [m] on vertex merge mean;");
  folder.write("lib/patterns.rule", "pattern edge2(a, b) { a -0- b; }");
  folder.write("lib/springs/one.rule",
               "interaction one on halfedge(a) { force a on dart = (0, 0, 0); }");
  folder.write("lib/criteria/two.rule",
               "import \"../springs/one.rule\"; criterion two of one { value 1; }");
  folder.write("lib/tear/three.rule", "rule three(a) { left { a; } }");
  gmsim::check::LibraryOptions options;
  options.stdlib_folder = folder.path() / "lib";
  CHECK(run({}, options).rules.files().size() == 5);

  options.modules = {"criteria"};
  const Run some = run({}, options);
  CHECK(some.diagnostics.all().empty());
  CHECK(some.rules.files().size() == 4);  // its import comes with it
  CHECK(some.rules.in(2).find_criterion("two")->from_library);

  options.modules = {"three", "tears"};
  const Run wrong = run({}, options);
  CHECK(wrong.rules.in(2).find_rule("three") != nullptr);
  REQUIRE(wrong.diagnostics.all().size() == 1);
  CHECK(wrong.diagnostics.all()[0].help == "did you mean `tear`?");
}

TEST_CASE("a user's function takes the place of the library's in user texts, with a warning") {
  const Folder folder;
  folder.write("lib/particles.rule",
               "function half(a) = 0.5; rule r(a) { left { a; } where half(a) > 0.4; }");
  const auto mine = folder.write("mine.rule", "function half(a) = 0.25;"
                                 "rule own(a) { left { a; } where half(a) > 0.4; }");
  gmsim::check::LibraryOptions options;
  options.stdlib_folder = folder.path() / "lib";
  const Run checked = run({mine}, options);
  CHECK_FALSE(checked.diagnostics.has_errors());
  REQUIRE(checked.diagnostics.all().size() == 1);
  CHECK(checked.diagnostics.all()[0].kind == DiagnosticKind::Shadowing);
  // What the library says about itself stays true.
  const auto* rule = checked.rules.in(2).find_rule("r");
  REQUIRE(rule != nullptr);
  CHECK(rule->steps[0].value->value.as_bool());
  const auto* own = checked.rules.in(2).find_rule("own");
  REQUIRE(own != nullptr);
  CHECK_FALSE(own->steps[0].value->value.as_bool());
}

TEST_CASE("a library file that is given itself takes its own place") {
  const Folder folder;
  folder.write("stdlib-rules/particles.rule", "embedding position : vec3 [m] on vertex;");
  const auto file =
      folder.write("stdlib-rules/tear/cut.rule", "rule cut(a) { left { a; } where true; }");
  gmsim::check::LibraryOptions options;
  options.stdlib_folder = folder.path() / "stdlib-rules";
  const Run checked = run({file}, options);
  CHECK(checked.diagnostics.all().empty());
  CHECK(checked.rules.files().size() == 2);
}
