// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <vector>

#include "parsed.h"
#include "samples.h"

using namespace gmsim::syntax;

namespace {

/// An indented tree in one line: `(label part part)`; names and numbers stand for themselves.
class OneLine {
 public:
  explicit OneLine(const std::string& tree) {
    std::istringstream in(tree);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
  }
  std::string text() { return node(0); }

 private:
  [[nodiscard]] std::size_t depth(std::size_t i) const { return lines_[i].find_first_not_of(' '); }

  std::string node(std::size_t level) {
    std::string label = lines_[next_++].substr(level);
    std::string parts;
    while (next_ < lines_.size() && depth(next_) > level) parts += " " + node(level + 2);
    for (const std::string prefix : {"name ", "number "})
      if (label.starts_with(prefix) && label.find(' ', prefix.size()) == std::string::npos)
        label = label.substr(prefix.size());
    return parts.empty() ? label : "(" + label + parts + ")";
  }

  std::vector<std::string> lines_;
  std::size_t next_ = 0;
};

const Expr& only(const ExprPtr& expr) {
  REQUIRE(expr);
  return *expr;
}

}  // namespace

TEST_CASE("expressions have the tree that precedence and associativity give them") {
  for (const Sample& sample : kExpressions) {
    CAPTURE(sample.source);
    const ParsedExpression parsed{std::string(sample.source)};
    CHECK(parsed.messages() == "");
    CHECK(OneLine(parsed.tree()).text() == sample.tree);
  }
}

TEST_CASE("numbers keep their text, their value and whether they are whole") {
  const auto number = [](const char* text) {
    const ParsedExpression parsed{text};
    return std::get<NumberExpr>(only(parsed.expr).node);
  };
  CHECK(number("1.50").text == "1.50");
  CHECK(number("1.50").value == 1.5);
  CHECK_FALSE(number("1.50").is_integer);
  CHECK(number("1e3").value == 1000);
  CHECK_FALSE(number("1e3").is_integer);
  CHECK(number("007").value == 7);
  CHECK(number("007").is_integer);
  CHECK(number("9007199254740993").value == 9007199254740992.0);
}

TEST_CASE("an expression spans all of its text and nothing else") {
  const ParsedExpression parsed{"  f(a) + (b.x - 1 [m])  // more"};
  const Expr& sum = only(parsed.expr);
  CHECK(parsed.sources.text(sum.span) == "f(a) + (b.x - 1 [m])");
  const auto& binary = std::get<BinaryExpr>(sum.node);
  CHECK(parsed.sources.text(binary.op_span) == "+");
  CHECK(parsed.sources.text(binary.left->span) == "f(a)");
  CHECK(parsed.sources.text(binary.right->span) == "(b.x - 1 [m])");
  const auto& difference = std::get<BinaryExpr>(binary.right->node);
  CHECK(parsed.sources.text(difference.left->span) == "b.x");
  CHECK(parsed.sources.text(difference.right->span) == "1 [m]");
  CHECK(parsed.sources.text(std::get<MemberExpr>(difference.left->node).member.span) == "x");
}

TEST_CASE("units have factors with exponents") {
  const auto unit = [](const std::string& text) {
    gmsim::support::SourceMap sources;
    gmsim::support::Diagnostics diagnostics;
    const auto parsed = parse_unit(sources, sources.add("unit", text), diagnostics);
    CHECK_FALSE(diagnostics.has_errors());
    REQUIRE(parsed);
    std::string found;
    for (const UnitFactor& factor : parsed->factors)
      found += factor.name.text + ":" + std::to_string(factor.numerator) + "/" +
               std::to_string(factor.denominator) + " ";
    return found;
  };
  CHECK(unit("1") == "");
  CHECK(unit("N/m") == "N:1/1 m:-1/1 ");
  CHECK(unit("N s/m") == "N:1/1 s:1/1 m:-1/1 ");
  CHECK(unit("kg m^2/s^2") == "kg:1/1 m:2/1 s:-2/1 ");
  CHECK(unit("N/(m s)") == "N:1/1 m:-1/1 s:-1/1 ");
  CHECK(unit("1/s") == "s:-1/1 ");
  CHECK(unit("m^-1") == "m:-1/1 ");
  CHECK(unit("m^(1/2)") == "m:1/2 ");
  CHECK(unit("m^(-3/2)") == "m:-3/2 ");
}
