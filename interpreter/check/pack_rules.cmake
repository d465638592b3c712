# cmake -DFOLDER=stdlib-rules -DOUTPUT=packed_rules.cpp -P pack_rules.cmake
# Writes every *.rule below FOLDER into a C++ source as string literals, sorted by path.

file(GLOB_RECURSE paths RELATIVE "${FOLDER}" "${FOLDER}/*.rule")
list(SORT paths)
set(rows "")
foreach(path IN LISTS paths)
  file(READ "${FOLDER}/${path}" hex HEX)
  # Bytes as \x.. escapes: any text is safe. A new literal every 40 bytes keeps lines short and
  # ends each escape.
  string(REGEX REPLACE "(..)" "\\\\x\\1" escaped "${hex}")
  string(LENGTH "${escaped}" length)
  set(text "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${escaped}" ${at} 160 piece)
    string(APPEND text "\n     \"${piece}\"")
    math(EXPR at "${at} + 160")
  endwhile()
  if(text STREQUAL "")
    set(text " \"\"")
  endif()
  string(LENGTH "${hex}" digits)
  math(EXPR bytes "${digits} / 2")
  string(APPEND rows "    {\"${path}\", std::string_view(${text}, ${bytes})},\n")
endforeach()

file(WRITE "${OUTPUT}" "// Generated from stdlib-rules by pack_rules.cmake; do not edit.
#include \"check/packed_rules.h\"

namespace gmsim::check {

const std::vector<PackedRule>& packed_rules() {
  static const std::vector<PackedRule> rules = {
${rows}  };
  return rules;
}

}  // namespace gmsim::check
")
