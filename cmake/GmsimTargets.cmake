# One place for the flags that every target of gmsim is built with.

add_library(gmsim_flags INTERFACE)
target_include_directories(gmsim_flags INTERFACE
  "${PROJECT_SOURCE_DIR}/interpreter" "${PROJECT_BINARY_DIR}/generated")
target_compile_options(gmsim_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
# Internal errors name files of the repository, wherever it was built.
target_compile_options(gmsim_flags INTERFACE "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")
if(GMSIM_SANITIZE)
  target_compile_options(gmsim_flags INTERFACE
    -fsanitize=${GMSIM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(gmsim_flags INTERFACE -fsanitize=${GMSIM_SANITIZE})
endif()

# gmsim_module(NAME SOURCES ... DEPENDS module ...): one library per folder of interpreter/.
# DEPENDS are exactly the arrows of docs/architecture.md; a test reads the includes against them.
function(gmsim_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LINK" ${ARGN})
  add_library(gmsim_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(gmsim_${name} PUBLIC gmsim_flags)
  foreach(module IN LISTS ARG_DEPENDS)
    target_link_libraries(gmsim_${name} PUBLIC gmsim_${module})
  endforeach()
  target_link_libraries(gmsim_${name} PUBLIC ${ARG_LINK})
endfunction()

# gmsim_test(NAME SOURCES ... LINK ... [LABELS ...]): one doctest program, registered with ctest.
function(gmsim_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS;ARGS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE gmsim_flags ${ARG_LINK} gmsim_test_main)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  add_test(NAME ${name} COMMAND ${name} ${ARG_ARGS} WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
  if(ARG_LABELS)
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}")
  endif()
endfunction()
