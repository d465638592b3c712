// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <sstream>

#include "support/trace.h"

using namespace gmsim::support;

TEST_CASE("a trace is silent until a phase is asked for") {
  std::ostringstream out;
  Trace trace(out);
  trace.line(TracePhase::Match, "dual", "1 row");
  CHECK(out.str().empty());
  CHECK(trace.enable("match"));
  trace.line(TracePhase::Match, "dual", "1 row");
  trace.line(TracePhase::Rewrite, "dual", "a=1");
  CHECK(out.str() == "match    dual 1 row\n");
}

TEST_CASE("a filter may name one rule") {
  std::ostringstream out;
  Trace trace(out);
  CHECK(trace.enable("rewrite:dual"));
  CHECK(trace.wants(TracePhase::Rewrite, "dual"));
  CHECK_FALSE(trace.wants(TracePhase::Rewrite, "cone"));
  CHECK_FALSE(trace.wants(TracePhase::Match, "dual"));
}

TEST_CASE("unknown phases are refused") {
  Trace trace;
  CHECK_FALSE(trace.enable("rewrit"));
  CHECK_FALSE(trace.enable(""));
  CHECK(trace.enable("step"));
  CHECK_FALSE(trace.wants(TracePhase::Step, ""));  // it has nowhere to write to
}

TEST_CASE("a line without a subject starts with its phase all the same") {
  std::ostringstream out;
  Trace trace(out);
  trace.enable("step");
  trace.line(TracePhase::Step, "", "412  t=0.412");
  CHECK(out.str() == "step     412  t=0.412\n");
}
