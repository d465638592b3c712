# cmake -DSOURCE=folder -DOUTPUT=file -P write_commit.cmake: a header with the commit of the source,
# written again only when it changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude *
  WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT
"#pragma once
namespace gmsim::cli {
inline constexpr const char* kCommit = \"@commit@\";
}
")
