# cmake -DFOLDER=interpreter/io/viewer -DOUTPUT=packed_viewer.cpp -P pack_viewer.cmake
# Writes the page and the script of the viewer into a C++ source as string literals.

set(functions "")
foreach(pair IN ITEMS "viewer_page page.html" "viewer_script viewer.bundle.js")
  separate_arguments(pair UNIX_COMMAND "${pair}")
  list(GET pair 0 name)
  list(GET pair 1 path)
  file(READ "${FOLDER}/${path}" hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR bytes "${digits} / 2")
  # Bytes as \x.. escapes: any text is safe.
  string(REGEX REPLACE "(..)" "\\\\x\\1" escaped "${hex}")
  string(APPEND functions "
std::string_view ${name}() {
  return std::string_view(\"${escaped}\", ${bytes});
}
")
endforeach()

file(WRITE "${OUTPUT}" "// Generated from ${FOLDER} by pack_viewer.cmake; do not edit.
#include \"io/viewer/viewer.h\"

namespace gmsim::io {
${functions}
}  // namespace gmsim::io
")
